"""Keys of `system.toml` in words, with their unit and an example as TOML."""

from __future__ import annotations

from collections.abc import Mapping

from pydantic import BaseModel

from mixedlub.schema import system_file

Words = Mapping[str, tuple[str, str]]
"""By key: example and meaning."""

MODELS: Mapping[str, type[BaseModel]] = {
    "gears": system_file.Gears,
    "contact": system_file.Contact,
    "lubricant": system_file.Lubricant,
    "surfaces": system_file.SurfaceSection,
    "uncertainty": system_file.Uncertainty,
    "recording": system_file.Recording,
}

MODULI = ("[206.0, 206.0]", "Young's moduli of the two bodies in GPa")
POISSON = ("[0.3, 0.3]", "Poisson's ratios of the two bodies")

HEAD: Words = {
    "boundary_friction": ("0.1", "friction coefficient of touching asperities"),
    "description": ('"rig, oil, campaign"', "free text"),
}

WORDS: Mapping[str, Words] = {
    "gears": {
        "teeth": ("[17, 26]", "teeth of pinion (driving) and gear"),
        "normal_module_mm": ("4.2333333", "normal module in mm"),
        "pressure_angle_deg": ("22.5", "normal pressure angle in degrees"),
        "helix_angle_deg": ("0.0", "helix angle in degrees"),
        "profile_shift": ("[0.0, 0.0]", "profile shift over module, pinion and gear"),
        "tip_diameter_mm": ("[80.5, 118.4]", "tip diameters in mm; from the module where left out"),
        "centre_distance_mm": ("91.0", "centre distance in mm; from the profile shift where left out"),
        "face_width_mm": ("14.0", "common face width in mm"),
        "youngs_modulus_GPa": MODULI,
        "poisson_ratio": POISSON,
        "load_sharing": (
            '{ model = "ldp", tip_relief_um = [15, 15], relief_length_mm = [2, 2] }',
            'elastic teeth, or { model = "rigid" } as where left out, or { table = "load_share.csv" }',
        ),
    },
    "contact": {
        "geometry": ('"line"', "line, or point for a ball"),
        "radius_mm": ("[20.0, 25.4]", "radii of the two bodies in mm, inf for a flat one"),
        "width_mm": ("6.0", "width of a line contact in mm; a point contact has none"),
        "youngs_modulus_GPa": MODULI,
        "poisson_ratio": POISSON,
    },
    "lubricant": {
        "name": ('"sample oil"', "name of the oil"),
        "base": ('"mineral"', "base stock: mineral, pao, ester or pag; its typical oil fills what is left out"),
        "temperature_C": ("[40.0, 100.0]", "two temperatures in degC, at which the next two are given"),
        "kinematic_viscosity_mm2_s": ("[30.0, 6.2]", "kinematic viscosity there in mm2/s"),
        "pressure_viscosity_per_GPa": ("[18.0, 14.0]", "pressure-viscosity coefficient there in 1/GPa"),
        "density_15C_kg_m3": ("850.0", "density at 15 degC in kg/m3"),
        "density_change_per_K": ("7e-4", "relative fall of the density in 1/K"),
        "eyring_stress_MPa": ("5.0", "Eyring stress in MPa"),
        "thermal_conductivity_W_mK": ("0.14", "thermal conductivity in W/(m K)"),
        "specific_heat_J_kgK": ("2000.0", "specific heat in J/(kg K)"),
    },
    "surfaces": {
        "m0_um2": ("0.137", "mean square height of the profile in um2"),
        "m2": ("0.0031", "mean square slope of the profile"),
        "m4_per_um2": ("0.0021", "mean square curvature of the profile in 1/um2"),
        "profile": ('"profiles/ground.csv"', "instead of the three moments: a trace in the case folder"),
        "cutoff_mm": ("0.8", "long cut-off in mm, for a trace"),
        "short_cutoff_um": ("2.5", "short cut-off in um, for a trace"),
        "form": ('"line"', "form taken off a trace: line, or polynomial-2 and so on"),
        "edges": ("false", "true cuts chamfers and falling ends off a trace, false keeps them"),
        "outliers": ("5.0", "mask spikes and pits of a trace further off than so many robust sigmas"),
        "coating": (
            '{ name = "DLC", thickness_um = 3.0, thermal_conductivity_W_mK = 2.0 }',
            "coating, thickness in um, conductivity in W/(m K); none where left out",
        ),
        "thermal_conductivity_W_mK": ("46.0", "thermal conductivity of the body in W/(m K)"),
        "density_kg_m3": ("7800.0", "density of the body in kg/m3"),
        "specific_heat_J_kgK": ("470.0", "specific heat of the body in J/(kg K)"),
    },
    "uncertainty": {
        "boundary_friction": ("0.012", "one sd of the boundary friction coefficient, absolute"),
        "viscosity": ("0.06", "one sd of the viscosity, relative"),
        "pressure_viscosity": ("0.06", "one sd of the pressure-viscosity coefficient, relative"),
        "eyring_stress": ("0.15", "one sd of the Eyring stress, relative"),
        "roughness": ("0.04", "one sd of Rq, relative"),
    },
    "recording": {
        "quantity": ('"power_loss_W"', "the column that the rig recorded"),
        "includes": ('"bearings and seals"', "what the reading contains beside the contact, free text"),
        "ambient_temperature_C": ("25.0", "temperature of the room in degC"),
        "check": ('"track_coverage_percent"', "column of a second channel, compared afterwards and never fitted"),
        "noise": (
            "{ relative = 0.01, absolute = 0.3 }",
            "one sd of a reading, as a share of it and in its unit; estimated where left out",
        ),
    },
}
