"""How much of the answer is choice: the shipped study under other readings of the model, and with an effect on."""

import tomllib
from pathlib import Path

from mixedlub.schema import toml_file
from mixedlub.study import read_study, run_study
from mixedlub.study.schema import StudyFile

SOURCE = Path(__file__).with_name("study_21_pairings.toml")
CHANGES = {
    "as shipped": {},
    "Barus viscosity": {"options": {"viscosity_law": "barus"}},
    "secant viscosity": {"options": {"effective_viscosity": "secant"}},
    "mean contact pressure": {"options": {"contact_pressure": "mean"}},
    "minimum film": {"options": {"film": "dowson_higginson_minimum"}},
    "averages of the paper": {"options": {"averaging": "paper"}},
    "inlet shear heating on": {"effects": {"inlet_shear_heating": {"strength": 1.0}}},
}

raw = tomllib.loads(SOURCE.read_text(encoding="utf-8"))
print(f"{'':24}{'mean friction':>22}{'largest loss (W)':>20}")
for name, change in CHANGES.items():
    file = toml_file.parse(StudyFile, {**raw, **change}, name)
    results = run_study(read_study(SOURCE, file))
    friction = results["mean_friction"]
    print(f"{name:24}{friction.min():12.4f} to {friction.max():.4f}{results['power_loss'].max():18.1f}")
