"""Cases of kind ``table`` made of cases of other kinds: the base model stands for the user's own simulation.

Run ``python -m tests.kinds.tables_of_cases OUT CASES`` for the comparison of both diagnoses on dealt cases.
"""

from __future__ import annotations

import json
import shutil
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd

from mixedlub.case.folder import read_case
from mixedlub.case.forward import Forward
from mixedlub.chain.priors import LogNormal, Normal
from mixedlub.diagnosis.diagnose import diagnose_case
from mixedlub.kinds.calibration import Calibration
from mixedlub.schema.table import Table
from mixedlub.schema.toml_file import read_toml, to_toml
from mixedlub.validation.battery import record
from mixedlub.validation.case_folder import write
from mixedlub.validation.rig import Case
from mixedlub.validation.sample_case import Order, sample_case

Z = 1.0


def as_table(native: Path, folder: Path) -> Path:
    """The same recording with columns of the base model and its derivatives, as an engineer has them."""
    case = read_case(native)
    assert case.recordings is not None
    forward = Forward(case, case.recordings)
    given = read_toml(native / "system.toml")
    free = [(c, c.name.replace(".", "_"), *_moved(c)) for c in forward.calibrations]
    folder.mkdir(parents=True)
    system = {
        **{k: v for k, v in given.items() if k not in ("kind", "uncertainty", "schema", "effects")},
        "uncertainty": {name: stated for _, name, stated, _ in free},
    }
    text = to_toml({"schema": "mixedlub-case/1", "kind": "table", **system})
    (folder / "system.toml").write_text(text, encoding="utf-8")
    if (native / "load_share.csv").exists():
        shutil.copy(native / "load_share.csv", folder)
    for name in ("recordings", "conditions"):
        if (native / f"{name}.csv").exists():
            frame = pd.read_csv(native / f"{name}.csv")
            table: Table | None = getattr(case, name)
            assert table is not None
            here = Forward(case, table, float(forward.inputs["reading_scale"]))
            frame["simulated"] = here.predict()
            for c, column, _, value in free:
                frame[f"simulated_{column}"] = here.predict({c.name: value})
            frame.to_csv(folder / f"{name}.csv", index=False)
    return folder


def _moved(c: Calibration) -> tuple[object, float]:
    """Uncertainty as stated for a table, and the value of the input one standard deviation up."""
    prior = c.parameter.prior
    if isinstance(prior, LogNormal) and c.factor:
        return prior.spread, prior.value(Z)
    if isinstance(prior, Normal):
        return {"value": c.nominal, "sd": prior.value(1.0) - prior.value(0.0)}, prior.value(Z)
    sd = abs(c.nominal) or 1.0
    return {"value": c.nominal, "sd": sd}, c.nominal + sd


@dataclass(frozen=True)
class Compared:
    """Verdicts of a recording with the package's model and with the same numbers as a table."""

    case: str
    planted: tuple[str, ...]
    native: tuple[str, ...]
    table: tuple[str, ...]
    tied: tuple[tuple[str, ...], ...]
    nameable: frozenset[str]

    @property
    def expected(self) -> tuple[str, ...]:
        """Verdict of the package's model, as far as a table can name it."""
        if set(self.native) <= self.nameable | {"none", "unknown"}:
            return self.native
        return ("unknown",)

    @property
    def same(self) -> bool:
        """Whether the verdicts agree at the level of a table."""
        return set(self.table) == set(self.expected)


def compared(native: Path, out: Path, planted: Iterable[str] = ()) -> Compared:
    """Diagnose a case and its table."""
    folder = as_table(native, out / f"{native.name}_table")
    first, second = diagnose_case(native), diagnose_case(folder)
    nameable = frozenset(e.id for e in second.search.problem.forward.effects())
    ids = second.posterior.tied
    return Compared(
        native.name,
        tuple(planted),
        tuple(first.posterior.verdict.ids),
        tuple(second.posterior.verdict.ids),
        tuple(tuple(one.ids) for one in ids),
        nameable,
    )


ORDERS = (
    ("gear_pair", "none", ()),
    ("disc", "none", ()),
    ("friction_map", "none", ()),
    *(
        ("gear_pair", label, (name,))
        for label, names in (
            ("measurement", ("sensor_offset", "sensor_gain", "sensor_drift", "heat_leak", "torque_offset")),
            ("single", ("windage", "churning", "bearing_drag", "seal_drag", "rolling_resistance", "starvation")),
        )
        for name in names
    ),
    *(("disc", "measurement", (name,)) for name in ("sensor_offset", "sensor_gain", "sensor_drift")),
    *(("disc", "single", (name,)) for name in ("film_heating", "limiting_shear_stress")),
    *(("friction_map", "measurement", (name,)) for name in ("zero_drift", "sensor_drift")),
    *(("friction_map", "single", (name,)) for name in ("stribeck", "direction_dependence")),
)
"""Kind, class and effects of the compared cases, in turn."""


def deal(index: int, seed: int, folder: Path) -> tuple[Path, tuple[str, ...]]:
    """A dealt case with its planted effects."""
    kind, label, effects = ORDERS[index % len(ORDERS)]
    order = Order(f"case_{index:03d}", kind, label, effects, "clear")
    rng = np.random.default_rng([seed, 2, index])
    sample = sample_case(rng, order)
    rig = sample.rig.refined
    truth = rig.records(sample.z, sample.acts)
    sd = sample.sd(truth)
    recorded, _ = record(rng, truth, sd, np.flatnonzero(~sample.hidden), False)
    noise = {"noise": {"relative": sample.relative, "absolute": sample.absolute}}
    counted = rig.settle(rig.records(sample.z, [act for act in sample.acts if act.stage != "sensor"]))
    settings = {**rig.settings, "recording": {**rig.settings["recording"], **noise}}
    case = Case(settings=settings, columns={**rig.columns, **counted}, share=rig.share)
    write(folder / order.name, case, {rig.quantity: recorded}, sample.hidden, {})
    return folder / order.name, effects


def main(out: Path, cases: int, seed: int = 11) -> None:
    out.mkdir(parents=True, exist_ok=True)
    done = out / "compared.jsonl"
    seen = len(done.read_text().splitlines()) if done.exists() else 0
    for index in range(seen, cases):
        try:
            native, effects = deal(index, seed, out / "native")
            shutil.rmtree(out / "tables" / f"{native.name}_table", ignore_errors=True)
            one = compared(native, out / "tables", effects)
            line = {**one.__dict__, "nameable": sorted(one.nameable), "expected": one.expected, "same": one.same}
        except Exception as error:  # a case that cannot be dealt or answered is a line of its own
            line = {"case": index, "order": ORDERS[index % len(ORDERS)], "error": repr(error), "same": False}
        with done.open("a", encoding="utf-8") as lines:
            lines.write(json.dumps(line) + "\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]), int(sys.argv[2]))
