"""Checks of a study's inputs against its friction law, before the computation."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from mixedlub import friction
from mixedlub.chain.friction_law import FrictionLaw
from mixedlub.chain.model import Model
from mixedlub.rig.lubricant import Lubricant
from mixedlub.schema.findings import finding, report
from mixedlub.study.options import ignored
from mixedlub.study.schema import Options, StudyFile
from profiles.errors import InputError

PLACE = "options.friction_coefficients"


def check_coefficients(options: Options, place: str = PLACE) -> None:
    """Raise an error for unknown or missing coefficients; report defaults."""
    law, given = friction.find(options.friction), options.friction_coefficients
    law.check_given(given, place, f"mixedlub friction-laws {law.name}")
    assumed = [f"{c.name} = {c.default:g}" for c in law.coefficients if c.name not in given]
    if assumed:
        report(finding("friction_coefficient_assumed", f"{', '.join(assumed)} taken for {law.name}", place))


def check_oil(law: FrictionLaw, given: Mapping[str, float], oil: Lubricant, place: str = PLACE) -> None:
    """Raise an error if a law valid for a single oil is used with another."""
    for name, one in law.of_oil.items():
        wanted = given.get(name, 0.0)
        own = float(oil.inputs(np.array(one.temperature))[one.quantity]) / one.factor
        if wanted > 0.0 and abs(own / wanted - 1.0) > one.tolerance:
            unit = next(c.unit for c in law.coefficients if c.name == name)
            rule = (
                f"the law is made from an oil of {wanted:.4g} {unit}, that of the study, {oil.name}, has {own:.4g} "
                f"{unit}; the two must agree within {100.0 * one.tolerance:g} %, since {law.name} friction is for one "
                "oil: make it from that of the study"
            )
            raise InputError(rule, where=f"{place}: {name}")


def check_viscosity(options: Options, oil: Lubricant) -> None:
    """Raise an error for the modulus equation with an oil without its constants; report unused constants."""
    if options.viscosity_law == "modulus":
        if oil.pressure_modulus is None:
            rule = "needs pressure_modulus_MPa and pressure_modulus_slope in [lubricant], or an oil that has them"
            raise InputError(rule, where="options.viscosity_law", value="modulus")
    elif oil.pressure_modulus is not None:
        text = f"{options.viscosity_law} in place of the modulus equation, whose constants the oil has"
        report(finding("oil_law_unread", text, "options.viscosity_law"))


def check_friction(file: StudyFile, model: Model) -> None:
    """Raise an error for options ignored by the friction law; report unread quantities and divergence."""
    options = file.options
    for option in ignored(options, model):
        if option in options.model_fields_set:
            rule = f"friction = {options.friction!r} does not read it; leave it out"
            raise InputError(rule, where=f"options.{option}", value=getattr(options, option))
    read = {name for step in model.steps for name in step.reads}
    if (key := "boundary_friction") in read and key not in file.model_fields_set:
        report(finding("boundary_friction_assumed", f"{file.boundary_friction:g} assumed", key))
    if options.friction == friction.BASE:
        return
    if options.balance != "none":
        rule = f"goes with the base model's friction; friction = {options.friction!r} is fitted to films without it"
        raise InputError(f"{rule}; leave one of them out", where="options.balance", value=options.balance)
    law = friction.find(options.friction)
    if "boundary_friction" in file.model_fields_set and "boundary_friction" not in read:
        report(finding("boundary_friction_unread", f"{law.name} does not read it", "boundary_friction"))
    if law.diverges_at_pitch_point:
        text = (
            f"{law.name} diverges at the pitch point, where sliding ends; the loss there goes to zero, but friction "
            "near it is no number to quote"
        )
        report(finding("friction_diverges", text, "options.friction"))
