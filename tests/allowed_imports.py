"""An import contract that lists what is ALLOWED: one line a package, and what no line allows is broken.

import-linter's own contracts list what is forbidden, so that they say nothing of a package or a library of tomorrow.
"""

import sys

from grimp import ImportGraph
from importlinter import Contract, ContractCheck, output
from importlinter.domain import fields


class AllowedImports(Contract):
    """Modules import their own root package, the standard library and what the longest line that fits them allows.

    Options
    -------
    allowed
        Lines ``package: name name ...``: what modules of ``package`` may import besides. A name stands for itself and
        for all below it.
    """

    allowed = fields.ListField(subfield=fields.StringField())

    def check(self, graph: ImportGraph, verbose: bool) -> ContractCheck:
        """Hold every module's direct imports against its line."""
        lines = dict(line.split(":") for line in self.allowed)
        table = {package.strip(): tuple(names.split()) for package, names in lines.items()}
        roots = {package.partition(".")[0] for package in table}
        broken = []
        for importer in sorted(module for module in graph.modules if module.partition(".")[0] in roots):
            line = max((package for package in table if _within(importer, package)), key=len)
            free = {importer.partition(".")[0], *sys.stdlib_module_names}
            for imported in sorted(graph.find_modules_directly_imported_by(importer)):
                known = imported.partition(".")[0] in free or any(
                    _within(imported, name) for name in table[line]
                )
                if not known:
                    broken.append((importer, imported, line))
        return ContractCheck(kept=not broken, metadata={"broken": broken})

    def render_broken_contract(self, check: ContractCheck) -> None:
        """Say which module imports what, and which line does not have it."""
        for importer, imported, line in check.metadata["broken"]:
            output.print_error(f"{importer} imports {imported}, which the line of {line} does not allow")


def _within(module: str, package: str) -> bool:
    return module == package or module.startswith(f"{package}.")
