"""The base model at the conditions of a case, with the effects named by the case; nothing is fitted."""

from __future__ import annotations

from typing import TYPE_CHECKING

from mixedlub.case.folder import Case, at_programme_end, other_recordings
from mixedlub.case.forward import Forward
from mixedlub.case.validity import judge_rows
from mixedlub.schema.findings import report
from mixedlub.schema.table import BOOKKEEPING, Table
from profiles.errors import InputError

if TYPE_CHECKING:
    import pandas as pd


def simulate(case: Case, at: Table | None = None) -> pd.DataFrame:
    """Run numbers and simulated readings, the conditions, recorded readings if any, and the validity. The rows are
    recordings and conditions, or the table ``at``; each run appears once."""
    import pandas as pd

    parts = []
    for table in simulated_tables(case, at):
        forward = Forward(case, table)
        judged = judge_rows(forward)
        for one in (*judged.findings, *forward.notes):
            report(one)
        simulated = pd.DataFrame({"run": table["run"], case.quantity: forward.base_prediction()})
        words = pd.Series(judged.words, name="validity")
        parts.append(pd.concat([simulated, conditions_of(case, table), words], axis=1))
    return pd.concat(parts, ignore_index=True).drop_duplicates("run")


def simulated_tables(case: Case, at: Table | None = None) -> list[Table]:
    """Recordings and conditions, or the table ``at``, with a place in the test programme where effects may need it."""
    tables = [table for table in ((case.recordings, case.conditions) if at is None else (at,)) if table is not None]
    if not tables:
        rule = "has neither recordings.csv nor conditions.csv; name a table with --at"
        raise InputError(rule + other_recordings(case.folder), where=str(case.folder))
    placed = case.system.effects or case.missing is not None
    return [at_programme_end(case, table) for table in tables] if placed else tables


def conditions_of(case: Case, table: Table) -> pd.DataFrame:
    """The conditions of a table's rows, followed by the recorded readings as ``recorded_QUANTITY``."""
    import pandas as pd

    names = [c.name for c in (*BOOKKEEPING, *case.kind.columns) if c.name in table]
    found = {name: table[name] for name in names}
    if case.quantity in table:
        found[f"recorded_{case.quantity}"] = table[case.quantity]
    return pd.DataFrame(found)
