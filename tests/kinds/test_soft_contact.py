"""Film of a ball on rubber: the pressure is some MPa, and the base model's film is for oils that pressure thickens."""

import numpy as np
import pytest

import mixedlub as ml
from mixedlub.case.folder import Case
from mixedlub.case.forward import Forward
from mixedlub.case.validity import judge_rows
from mixedlub.diagnosis.diagnose import diagnosis_of
from mixedlub.laws.film import hamrock_dowson_soft
from mixedlub.rig.plausibility import implausible
from mixedlub.schema.findings import Severity, codes

LOAD, SPEED = (np.ravel(grid) for grid in np.meshgrid([1.0, 4.0, 15.0], [0.01, 0.04, 0.1, 0.4]))


def ball(modulus_GPa: float, poisson_ratio: float) -> Case:
    """Films of the law of soft contacts, 1 % rounded off."""
    modulus = 2.0 / ((1 - 0.3**2) / 206e9 + (1 - poisson_ratio**2) / (1e9 * modulus_GPa))
    film = hamrock_dowson_soft(12e-3, 12e-3, SPEED, LOAD, 0.17, modulus)
    system = {
        "kind": "film",
        "lubricant": {
            "temperature_C": [25.0, 40.0],
            "kinematic_viscosity_mm2_s": [195.4, 95.0],
            "pressure_viscosity_per_GPa": [18.0, 17.0],
            "density_15C_kg_m3": 876.0,
        },
        "contact": {
            "geometry": "point",
            "radius_mm": [12.0, np.inf],
            "youngs_modulus_GPa": [206.0, modulus_GPa],
            "poisson_ratio": [0.3, poisson_ratio],
        },
        "recording": {"quantity": "film_thickness_nm", "noise": {"relative": 0.02}},
    }
    rows = {
        "load_N": LOAD,
        "entrainment_speed_m_s": SPEED,
        "slide_roll_ratio": np.zeros(LOAD.size),
        "oil_temperature_C": np.full(LOAD.size, 25.0),
        "film_thickness_nm": np.round(1e9 * film, 1),
    }
    return ml.case.case_of(system, rows)


@pytest.mark.parametrize(
    ("modulus_GPa", "poisson_ratio", "grade"), [(0.1, 0.4999, "not_quantitative"), (70.0, 0.22, "valid")]
)
def test_the_film_of_hard_contacts_is_graded_on_each(modulus_GPa: float, poisson_ratio: float, grade: str) -> None:
    case = ball(modulus_GPa, poisson_ratio)
    assert case.recordings is not None
    forward = Forward(case, case.recordings)
    assert {words.partition("; ")[0] for words in judge_rows(forward).words} == {grade}
    assert ("soft_contact_film" in [e.id for e in forward.effects()]) == (grade != "valid")
    assert "valid" in judge_rows(forward, {"soft_contact_film": {"share": 1.0}}).words or grade == "valid"


def test_a_soft_film_is_named_and_its_base_model_doubted() -> None:
    found = diagnosis_of(ball(0.1, 0.4999))
    assert any("soft_contact_film" in key.ids for key in found.posterior.tied)
    (told,) = [one for one in found.warnings if one.code == "law_extrapolated"]
    assert told.severity == Severity.DOUBT


@pytest.mark.parametrize(("poisson_ratio", "asked"), [(0.4999, False), (0.3, True)])
def test_a_small_modulus_is_asked_about_unless_the_body_is_rubber(poisson_ratio: float, asked: bool) -> None:
    assert ("value_unusual" in codes(implausible(ball(0.15, poisson_ratio).rig))) == asked
