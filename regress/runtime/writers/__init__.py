"""What becomes of answers: tables, and animations of avatars; all take one record."""

from regress.runtime.writers.avatar import animated_avatar
from regress.runtime.writers.csv_table import confidence_csv, csv_lines, weights_csv
from regress.runtime.writers.tables import TABLES, TableWriter

__all__ = ["TABLES", "TableWriter", "animated_avatar", "confidence_csv", "csv_lines", "weights_csv"]
