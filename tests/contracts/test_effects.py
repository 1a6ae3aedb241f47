"""What every effect of the catalogue must do; a new file is tested without a line of test code."""

from __future__ import annotations

import inspect
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest

from mixedlub.chain.effect import Effect
from mixedlub.chain.model import Model
from mixedlub.chain.plain_text import plain_equation
from mixedlub.chain.quantities import GLOSSARY
from mixedlub.effects import catalogue, known_in
from mixedlub.report.effect_pages import effects_text, fingerprint, lookalikes, share
from mixedlub.schema.units import dimension
from profiles.errors import InputError
from tests.contracts.rigs import DISSIPATED, EFFECTS, RIGS, acting, apply, cases, moved, on_rigs, rig, states

each = pytest.mark.parametrize("effect", EFFECTS, ids=[e.id for e in EFFECTS])
each_case = pytest.mark.parametrize(("name", "effect_id"), cases())

PHYSICAL = {
    "film_thickness": (1e-10, 1e-4),
    "area_ratio": (0.0, 1.0),
    "boundary_friction": (0.0, 1.0),
    "shear_stress": (0.0, 1e9),
    "friction": (0.0, 1.0),
    "load_share": (0.0, 1.6),
    "line_load": (0.0, 1e8),
    "transmitted_force": (0.0, 1e6),
    "m0": (0.0, 1e-10),
    "m2": (0.0, 1.0),
    "m4": (0.0, 1e12),
    "rolling_force": (0.0, 1e4),
    "power_loss": (0.0, 1e5),
}
"""Bounds that a quantity keeps whatever the parameters; others must only stay finite."""

CONDITIONS = ("load", "speed", "slide_roll_ratio", "oil_temperature", "roughness", "sequence")


PAGES = ("churning", "pressure_viscosity_law", "sensor_offset")
"""Effects whose pages are looked at: with laws that they contain, with a long equation, with neither."""

HOME = ("gear_pair", "disc")
"""The rigs whose loss and friction a fingerprint speaks of; of what shows on neither, the first rig that shows it."""


def home(effect: Effect) -> dict[str, dict[str, str]]:
    """The computed fingerprints that the declared one is held against."""
    found = {name: fingerprint(effect, name) for name in RIGS}
    shown = {name: signs for name, signs in found.items() if signs}
    near = {name: signs for name, signs in shown.items() if name in HOME}
    return near or dict(list(shown.items())[:1])


def positive_loss(name: str, effects: tuple[Effect, ...]) -> None:
    """With these effects on, readings are finite and what is dissipated, or a film, is positive wherever it slides."""
    forward = rig(name)
    want = DISSIPATED[name]
    model = Model(forward.chain, tuple(forward.inputs), ("reading", want), effects)
    found = model(forward.inputs, {e.id: moved(e) for e in effects})
    assert np.isfinite(found["reading"]).all()
    size = found[want] * np.sign(forward.inputs.get("drive_speed", 1.0))
    assert (size >= 0).all()
    slides = np.max(forward.inputs.get("sliding_speed", 1.0), axis=-1, keepdims=True) > 0
    assert size[np.broadcast_to(slides, size.shape)].min() > 0


@each_case
def test_null_is_the_base_model_bit_for_bit(name: str, effect_id: str) -> None:
    effect = catalogue()[effect_id]
    assert np.array_equal(rig(name).predict(), rig(name).predict(None, {effect_id: effect.nulls}))


@each
@pytest.mark.parametrize("name", RIGS)
def test_null_leaves_what_it_acts_on_untouched(name: str, effect: Effect) -> None:
    state = states()[name]
    after = apply(effect, state, effect.nulls)
    for quantity in effect.acts_on:
        assert np.array_equal(*np.broadcast_arrays(after[quantity], state[quantity])), quantity


@each_case
def test_switched_on_it_changes_the_reading(name: str, effect_id: str) -> None:
    values = moved(catalogue()[effect_id])
    assert not np.allclose(rig(name).predict(), rig(name).predict(None, {effect_id: values}), rtol=1e-6)


@each_case
def test_alone_and_in_every_pair_the_loss_is_finite_and_positive(name: str, effect_id: str) -> None:
    effect = catalogue()[effect_id]
    positive_loss(name, (effect,))
    for other in acting(name):
        if other.id > effect_id:
            positive_loss(name, (effect, other))


@each
def test_it_acts_on_the_rig_of_every_kind_it_names(effect: Effect) -> None:
    """So that any two effects of one kind are tried together above; standard rigs have hard contacts."""
    if effect.offered_within:
        return
    assert on_rigs(effect)
    assert set(effect.kinds) <= set(on_rigs(effect))


@pytest.mark.parametrize("name", RIGS)
def test_all_on_the_loss_is_finite_and_positive(name: str) -> None:
    positive_loss(name, acting(name))


def sharing_a_quantity() -> list[tuple[Effect, Effect]]:
    return [(a, b) for a, b in combinations(EFFECTS, 2) if set(a.acts_on) & set(b.acts_on)]


@pytest.mark.parametrize(("a", "b"), sharing_a_quantity(), ids=lambda e: e.id)
def test_effects_on_one_quantity_commute_or_are_ordered(a: Effect, b: Effect) -> None:
    if a.kinds and b.kinds and not set(a.kinds) & set(b.kinds):
        return
    ordered = (b.id in a.applied_after) + (a.id in b.applied_after)
    assert ordered < 2, "each waits for the other"
    if ordered:
        return
    for name in RIGS:
        state = states()[name]
        one = apply(b, apply(a, state, moved(a)), moved(b))
        other = apply(a, apply(b, state, moved(b)), moved(a))
        for quantity in set(a.acts_on) | set(b.acts_on):
            np.testing.assert_allclose(one[quantity], other[quantity], rtol=1e-13, err_msg=quantity)


@each
def test_declared_fingerprint_is_the_computed_one(effect: Effect) -> None:
    computed = home(effect)
    for condition, sign in effect.fingerprint.items():
        assert condition in CONDITIONS or condition in GLOSSARY, condition
        found = {name: signs[condition] for name, signs in computed.items() if condition in signs}
        assert found, f"{condition}: computed nowhere"
        assert set(found.values()) == {sign}, f"{condition}: declared {sign}, computed {found}"


@each
def test_typical_parameters_keep_the_quantity_physical(effect: Effect) -> None:
    bounds = [p.typical for p in effect.parameters]
    corners = np.array(np.meshgrid(*bounds)).reshape(len(bounds), -1).T
    for name in on_rigs(effect):
        for corner in corners:
            values = dict(zip((p.name for p in effect.parameters), map(float, corner), strict=True))
            after = apply(effect, states()[name], values)
            for quantity in effect.acts_on:
                found = np.asarray(after[quantity])
                low, high = PHYSICAL.get(quantity, (-np.inf, np.inf))
                assert np.isfinite(found).all(), (quantity, values)
                assert found.min() >= low, (quantity, values)
                assert found.max() <= high, (quantity, values)


@each_case
def test_smooth_in_its_parameters(name: str, effect_id: str) -> None:
    """Central differences over two small steps agree; what a search must scan finely changes over finer steps."""
    effect = catalogue()[effect_id]

    def slope(k: int, step: float) -> np.ndarray:
        step /= max(effect.parameters[k].n_scan, 1)
        low, high = (
            rig(name).predict(
                None, {effect_id: effect.values(np.where(np.arange(len(effect.parameters)) == k, z, 0.3))}
            )
            for z in (0.3 - step, 0.3 + step)
        )
        return (high - low) / (2.0 * step)

    for k in range(len(effect.parameters)):
        coarse, fine = slope(k, 0.04), slope(k, 0.01)
        assert np.abs(coarse - fine).max() <= 0.03 * np.abs(fine).max(), effect.parameters[k].name


@each
def test_says_what_it_is(effect: Effect) -> None:
    text = inspect.getdoc(effect.law) or ""
    assert effect.summary.endswith(".")
    assert ">>>" in text, "no worked number"
    assert effect.equation.strip()
    assert effect.source.strip()
    assert len(effect.separated_by) > 20
    assert effect.fingerprint or not any(fingerprint(effect, name) for name in RIGS)
    assert any(p.null is not None for p in effect.parameters), "nothing switches it off"
    for p in effect.parameters:
        assert p.meaning.strip()
        dimension(p.unit)
        assert p.typical[0] < p.typical[1]


@each
def test_one_file_one_effect(effect: Effect) -> None:
    module = inspect.getmodule(effect.law)
    assert module is not None
    assert Path(module.__file__ or "").stem == effect.id
    assert [e.id for e in EFFECTS if e.law.__module__ == module.__name__] == [effect.id]


@pytest.mark.parametrize("effect", [catalogue()[name] for name in PAGES], ids=PAGES)
def test_page_shows_equation_source_and_separating_test(effect: Effect) -> None:
    page = " ".join(effects_text(effect.id).split())
    for part in (effect.summary, plain_equation(effect.equation), effect.source, effect.separated_by):
        assert " ".join(part.split()) in page
    assert "\\" not in page


@pytest.mark.parametrize(("name", "effect_id"), [case for case in cases() if case[1] in PAGES])
def test_page_shows_the_fingerprint_on_every_rig_where_it_shows(name: str, effect_id: str) -> None:
    page = " ".join(effects_text(effect_id).split())
    signs = ", ".join(f"{condition} {sign}" for condition, sign in fingerprint(catalogue()[effect_id], name).items())
    assert not signs or f"fingerprint share of the reading with growing {signs}" in page


@each
def test_page_shows_what_each_published_law_changes_on_gears(effect: Effect) -> None:
    if "gear_pair" not in on_rigs(effect) or not np.any(share(effect.id, "gear_pair")):
        return
    page = " ".join(effects_text(effect.id).partition("  gear_pair ")[2].split())
    told = page.partition("as published ")[2]
    laws = known_in("gear_pair")[effect.id].laws_within_reach
    assert told
    assert all(f"{law}: " in told for law in laws), laws


def test_table_lists_every_effect() -> None:
    table = effects_text(None)
    assert all(e.id in table for e in EFFECTS)


def test_a_published_law_is_within_reach_where_what_is_held_is_already_its_own() -> None:
    """A viscometer knows no slope that changes with temperature, nor does Roelands; discs start from his law."""
    law = catalogue()["pressure_viscosity_law"].special_cases["Roelands"]
    sample = known_in("viscosity")["pressure_viscosity_law"]
    assert set(law) - set(sample.laws_within_reach["Roelands"]) == {"slope_with_temperature", "slope_bow"}
    assert known_in("disc")["pressure_viscosity_law"].laws_within_reach == {}
    assert sample.fixing(sample.laws_within_reach["Roelands"]).laws_within_reach == {}


@pytest.mark.parametrize("effect", [catalogue()[name] for name in PAGES], ids=PAGES)
def test_page_names_the_laws_that_an_effect_contains(effect: Effect) -> None:
    page = " ".join(effects_text(effect.id).split())
    assert all(f"special case {law}, at " in page for law in effect.special_cases)


def test_unknown_effect_names_the_nearest() -> None:
    with pytest.raises(InputError, match="windage"):
        effects_text("windag")


@pytest.mark.parametrize("name", RIGS)
def test_lookalikes_are_mutual(name: str) -> None:
    for effect in EFFECTS:
        for other in lookalikes(effect.id, name):
            assert effect.id in lookalikes(other, name)
