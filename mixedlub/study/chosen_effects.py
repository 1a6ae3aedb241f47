"""Effects switched on in a study, with their parameter values, checked before the computation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from mixedlub import friction
from mixedlub.chain.effect import Effect
from mixedlub.chain.model import Parameters, available
from mixedlub.chain.slots import SLIDING_POWER, STEPS
from mixedlub.effects import LAW, find, known_effects, known_in
from mixedlub.own_laws import check_usable
from mixedlub.schema.findings import finding, report
from mixedlub.schema.system_file import Gears, LoadSharing, Uncertainty
from mixedlub.study.heat import BULK, check_exponent
from mixedlub.study.options import study_chain
from mixedlub.study.schema import Options, StudyFile
from profiles.errors import InputError

TEETH = "load sharing of the teeth"
"""Step that the section of the gears chooses too."""
AREA_ALONE = ("balance", "asperities", "mixture", "heights")
"""Options that must have their defaults with an effect on the contact area, because it leaves the asperity load
unchanged."""


def chosen_effects(
    file: StudyFile, inputs: Mapping[str, Any], laws: Mapping[str, Effect]
) -> tuple[tuple[Effect, ...], Parameters]:
    """The active effects, with each parameter at its given value or at the value of its law; ``laws``: of the user."""
    _refuse_unread(file, tuple(inputs))
    for e in find(sorted(file.effects), "effects", laws):
        _refuse_ignored(e, file.options)
        _refuse_second_law(e, file.options)
        _refuse_stated_teeth(e, file.gears.load_sharing)
        _refuse_stated_rise(e, file.options)
    chain = study_chain(file.options)
    for law in laws.values():
        check_usable(law, chain, _corners(inputs), "power_loss", "study")
    known = known_effects(file.effects, "gear_pair", chain, tuple(inputs), "power_loss", laws)
    for effect, name in known.sds:
        rule = f"a study takes no uncertainty of effects, only [uncertainty] of {', '.join(Uncertainty.model_fields)}"
        raise InputError(f"{rule}; leave it out", where=f"effects.{effect}.{name}_sd")
    check_exponent(known.values)
    for e in known.effects:
        _tell_defaults(e, file.effects[e.id], known.values[e.id])
    return known.effects, known.values


def with_traction(file: StudyFile, effects: Mapping[str, Any]) -> Mapping[str, Any]:
    """Effects of a study with those of its oil's traction part; effects stated in the file take precedence."""
    part = None if file.lubricant is None else file.lubricant.traction
    options = file.options
    if part is None or options.base != Options().base:
        return effects
    for name in ("friction", "effective_viscosity"):
        if getattr(options, name) != getattr(Options(), name):
            text = f'the traction part of the oil is not read with {name} = "{getattr(options, name)}"'
            report(finding("traction_unread", text, f"options.{name}"))
            return effects
    for one in part.told(effects.keys()):
        report(one)
    return {**part.effects(uncertain=False), **effects}


def _corners(inputs: Mapping[str, Any]) -> dict[str, Any]:
    """Inputs at the first and last levels of each factor, at all points of the path."""
    found = dict(inputs)
    for name, value in inputs.items():
        for axis in range(np.ndim(value) - 1):
            found[name] = np.take(found[name], [0, -1] if np.shape(value)[axis] > 1 else [0], axis)
    return found


def _refuse_ignored(e: Effect, options: Options) -> None:
    """Raise an error for an effect that reaches only part of the chosen laws."""
    default = Options()
    changed = [
        f'{name} = "{getattr(default, name)}"'
        for name in AREA_ALONE
        if getattr(options, name) != getattr(default, name)
    ]
    if "load_share" in e.acts_on and options.averaging != SLIDING_POWER.default:
        rule = (
            f"moves load between points of the path, which {options.averaging!r} averages do not see; needs averaging"
        )
        raise InputError(f'{rule} = "{SLIDING_POWER.default}"', where=f"effects.{e.id}")
    if "area_ratio" in e.acts_on and changed:
        rule = f"changes the contact area and not the load of the asperities; it needs {' and '.join(changed)}"
        other = '; for asperities that yield, asperities = "chang_etsion_bogy" has the same law with its load'
        raise InputError(rule + (other if e.id == "asperity_plasticity" else ""), where=f"effects.{e.id}")


def _refuse_second_law(e: Effect, options: Options) -> None:
    """Raise an error for an effect that replaces a step with a non-default law."""
    default = Options()
    for name in STEPS.get(e.replaces, ()):
        value = getattr(options, name)
        if value != getattr(default, name):
            rule = f'and options.{name} = "{value}" are two laws of one step, the {e.replaces}; leave one of them out'
            raise InputError(rule, where=f"effects.{e.id}")


def _refuse_stated_teeth(e: Effect, sharing: LoadSharing) -> None:
    """Raise an error for an effect on the load sharing that the gears state already."""
    fields = type(sharing).model_fields
    stated = [key for key in fields if key.startswith(f"{e.id}_") and getattr(sharing, key) != fields[key].default]
    if e.replaces == TEETH and sharing.chosen is not Gears.model_fields["load_sharing"].default.chosen:
        stated.append(sharing.chosen.chosen_by or "model")
    if stated:
        rule = (
            f"and gears.load_sharing.{stated[0]} state the same part of the load sharing twice; leave one of them out"
        )
        raise InputError(rule, where=f"effects.{e.id}")


def _refuse_stated_rise(e: Effect, options: Options) -> None:
    """Raise an error for the effect of warm teeth beside a stated temperature of the oil at the inlet."""
    if e.id == BULK and options.bulk_temperature_rise_K:
        rule = "and options.bulk_temperature_rise_K state the temperature of the teeth twice; leave one of them out"
        raise InputError(rule, where=f"effects.{BULK}")


def _tell_defaults(e: Effect, given: Mapping[str, float | str], values: Mapping[str, float]) -> None:
    """Report default laws, parameter values of no law, and effects at their null."""
    taken, *others = e.laws_within_reach or ("",)
    if others and LAW not in given and not given.keys() >= e.laws_within_reach[taken].keys():
        text = f"taken as the law of {taken}; law = NAME chooses {' or '.join(others)}"
        report(finding("effect_law_assumed", text, f"effects.{e.id}"))
    switches = {p.name: p.null for p in e.parameters if p.null is not None}
    if switches and all(values[name] == null for name, null in switches.items()) and not switches.keys() & given.keys():
        text = f"changes nothing: a value for {' or '.join(switches)} switches it on"
        report(finding("effect_off", text, f"effects.{e.id}"))
        return
    known = {*given, *e.laws_within_reach.get(str(given.get(LAW, taken)), {})}
    # A factor of 1 leaves the law as it is.
    usual = [p for p in e.parameters if p.name not in known and p.nominal is None and values[p.name] not in (p.null, 1)]
    if usual:
        numbers = ", ".join(f"{p.name} = {values[p.name]:g} {p.unit.strip('-')}".strip() for p in usual)
        report(finding("effect_number_assumed", f"taken, as the file gives none: {numbers}", f"effects.{e.id}"))


def _refuse_unread(file: StudyFile, given: Sequence[str]) -> None:
    """Raise an error for effects on quantities that the friction law does not read."""
    if file.options.friction == friction.BASE:
        return
    base = study_chain(Options())
    chain = study_chain(file.options)
    own = known_in("gear_pair")
    for name in file.effects:
        reaches = [name in own and available(own[name], c, given, "power_loss", "gear_pair") for c in (base, chain)]
        if reaches == [True, False]:
            rule = (
                f"would change nothing, as friction = {file.options.friction!r} does not read it; leave one of them out"
            )
            raise InputError(rule, where=f"effects.{name}")
