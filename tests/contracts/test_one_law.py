"""One step of the model holds one law, whoever chose it: an option, an effect, or two effects."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

import pytest

import mixedlub as ml
from mixedlub import effects
from mixedlub.case import reference_rigs
from mixedlub.case.forward import Forward
from mixedlub.chain.effect import EFFECTS
from mixedlub.chain.slots import SLOTS, STEPS
from mixedlub.effects import catalogue
from mixedlub.efficiency import EXAMPLE, read_gearbox
from mixedlub.friction import BASE
from mixedlub.study.schema import Options
from profiles.errors import InputError

REPLACING = {e.id: e for e in catalogue().values() if e.replaces and (not e.kinds or "gear_pair" in e.kinds)}
"""Effects of gears that take the place of a step."""
VALUES = {
    **{slot.option: tuple(slot.choices) for slot in SLOTS},
    "balance": ("none", "johnson_greenwood_poon"),
    "film_roughness": ("none", "patir_cheng"),
    "heights": ("gaussian", "measured", "plateau", "auto"),
    "viscosity_pressure": ("maximum", "mean"),
    "friction": (BASE, "schlenk", "crook"),
}
DEFAULTS = {name: field.default for name, field in Options.model_fields.items()}
CHOICES = [(option, value) for option, values in VALUES.items() for value in values if value != DEFAULTS[option]]
BY_OPTION = {
    ("film_law", "Dowson and Higginson"): {"film": "dowson_higginson_minimum"},
    ("film_law", "Moes"): {"film": "moes"},
    ("mixture_law", "weights by load"): {"mixture": "load_weighted"},
    ("load_balance", "Johnson, Greenwood and Poon"): {"balance": "johnson_greenwood_poon"},
}
"""Laws of effects that an option chooses as well."""
NAMED = dict.fromkeys([*((e.id, next(iter(e.laws_within_reach), "")) for e in REPLACING.values()), *BY_OPTION])
"""Each effect by its first law, and by those that an option chooses as well."""


@pytest.fixture(scope="module")
def loss() -> Any:
    """Power loss and film under options and effects."""
    pair = ml.gear_pair(teeth=(17, 26), normal_module_mm=4.2333, pressure_angle_deg=22.5, face_width_mm=14.0)
    ground = ml.surface("shipped:0258", cutoff_mm=0.8, lay="isotropic")
    known: dict[str, tuple[float, float]] = {}
    oil = ml.oil(
        "mineral",
        temperature_C=[40.0, 100.0],
        pressure_modulus_MPa=[55.6, 71.4],
        pressure_modulus_slope=[0.03, 0.04],
    )

    def of(options: dict[str, Any], taken: dict[str, Any]) -> tuple[float, float]:
        place = repr((options, taken))
        if place not in known:
            condition = {"torque_Nm": 100.0, "speed_rpm": 1500.0, "oil_temperature_C": 60.0}
            found = ml.power_loss(pair, oil, ground, options=options, effects=taken, **condition)
            known[place] = (found["power_loss_W"].item(), found["film_thickness_um"].item())
        return known[place]

    return of


def chosen(option: str, value: str) -> dict[str, Any]:
    """The options of a value, with the hardness that yielding asperities need."""
    yields = option == "asperities" and value != "greenwood_tripp"
    return {option: value, **({"hardness_GPa": 6.0} if yields else {})}


def test_every_effect_that_replaces_names_a_step() -> None:
    assert {e.replaces for e in REPLACING.values()} == set(STEPS)
    assert {option for options in STEPS.values() for option in options} <= set(VALUES)


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize(("option", "value"), CHOICES)
@pytest.mark.parametrize(("effect", "law"), NAMED)
def test_an_option_and_an_effect_never_apply_a_law_twice(
    loss: Any, option: str, value: str, effect: str, law: str
) -> None:
    """Refused with both keys, or the result of one of them, or of two steps as two options would choose them."""
    options, taken = chosen(option, value), {effect: {"law": law} if law else {}}
    try:
        found, refused = loss(options, taken), ""
    except InputError as error:
        found, refused = None, str(error)
    if refused:
        assert effect in refused
        assert option in refused
        return
    assert option not in STEPS[REPLACING[effect].replaces]
    alone = [loss(options, {}), loss({}, taken)]
    if not any(found == pytest.approx(one, rel=1e-12) for one in alone) and (effect, law) in BY_OPTION:
        assert found == pytest.approx(loss({**options, **BY_OPTION[effect, law]}, {}), rel=1e-6)


def test_two_effects_of_two_steps_are_as_two_options(loss: Any) -> None:
    options = {
        **BY_OPTION["film_law", "Dowson and Higginson"],
        **BY_OPTION["load_balance", "Johnson, Greenwood and Poon"],
    }
    found = loss({}, {"film_law": {"law": "Dowson and Higginson"}, "load_balance": {}})
    assert found == pytest.approx(loss(options, {}), rel=1e-9)


@pytest.mark.parametrize(
    ("effect", "options"),
    [
        ("film_law", {"film": "moes"}),
        ("mixture_law", {"mixture": "load_weighted"}),
        ("load_balance", {"balance": "johnson_greenwood_poon"}),
        ("asperity_law", {"asperities": "greenwood_tripp"}),
        ("pressure_viscosity_law", {"viscosity_law": "barus"}),
        ("shear_law", {"effective_viscosity": "secant"}),
    ],
)
def test_both_keys_are_named_for_each_step(loss: Any, effect: str, options: dict[str, str]) -> None:
    (option,) = options
    with pytest.raises(InputError) as error:
        loss(options, {effect: {}})
    assert error.value.where.endswith(f"effects.{effect}")
    assert f"options.{option} = " in error.value.rule


@pytest.mark.parametrize(
    ("effect", "stated"),
    [
        ("load_sharing_law", {}),
        ("tip_relief", {"tip_relief_um": [15, 15], "relief_length_mm": [2, 2]}),
        ("misalignment", {"misalignment_um": 20.0}),
    ],
)
def test_the_gears_and_an_effect_never_state_a_load_sharing_twice(effect: str, stated: dict[str, Any]) -> None:
    teeth = {"teeth": (17, 26), "normal_module_mm": 4.2333, "pressure_angle_deg": 22.5, "face_width_mm": 14.0}
    condition = {"torque_Nm": 100.0, "speed_rpm": 1500.0, "oil_temperature_C": 60.0}
    pair = ml.gear_pair(**teeth, load_sharing={"model": "ldp", **stated})
    ground = ml.surface("shipped:0258", cutoff_mm=0.8)
    with pytest.raises(InputError, match=rf"effects\.{effect}: and gears\.load_sharing\."):
        ml.power_loss(pair, ml.oil("mineral"), ground, effects={effect: {}}, **condition)


def test_the_stage_of_a_gearbox_holds_one_law(tmp_path: Path) -> None:
    text = EXAMPLE.read_text(encoding="utf-8")
    for table, line in (("options", 'film = "moes"'), ("effects", 'film_law = { law = "Moes" }')):
        head = next(one for one in text.splitlines() if one.startswith(f"[stages.first.{table}]"))
        text = text.replace(head, f"{head}\n{line}")
    (tmp_path / "box.toml").write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=r"stages\.first\.effects\.film_law: .*options\.film = "):
        read_gearbox(tmp_path / "box.toml")


@pytest.fixture
def rival(monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    """A second effect that replaces the film."""
    both = MappingProxyType({**catalogue(), "film_of_moes": replace(catalogue()["film_law"], name="film_of_moes")})
    monkeypatch.setattr(EFFECTS, "all", both)
    effects.known_in.cache_clear()
    yield "film_of_moes"
    effects.known_in.cache_clear()


def test_two_effects_on_one_step_are_refused_in_studies_and_cases(loss: Any, rival: str) -> None:
    both: dict[str, Any] = {"film_law": {}, rival: {}}
    refused = r"effects\.film_of_moes: .*effects\.film_law"
    with pytest.raises(InputError, match=refused):
        loss({}, both)
    case = reference_rigs.case("gear_pair")
    with pytest.raises(InputError, match=refused):
        Forward(
            replace(case, system=case.system.model_copy(update={"effects": both})), reference_rigs.table("gear_pair")
        )
