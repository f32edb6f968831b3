"""What a trained model does to faces that are made for the question: noise, turned heads, one shape alone, still faces.

Everything here is measured on people of the test split, from columns that only a facegen dataset has (exact
points, points in the head, camera). A model alone cannot answer these questions, so they are asked when a report is
written with a dataset, and cost training nothing.
"""

from regress.learning.probes.faces import ProbeFaces, read_faces
from regress.learning.probes.measured import Measured, figures_of, measure

__all__ = ["Measured", "ProbeFaces", "figures_of", "measure", "read_faces"]
