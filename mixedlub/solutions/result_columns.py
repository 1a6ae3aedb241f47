"""Columns of the tables of `mixedlub condense` and `mixedlub law-errors`."""

from __future__ import annotations

from mixedlub.schema.result import described

OF_OIL = {"oil": "text: oil by name or file", "rig": "number of the rig"}
CONDITIONS = {
    "radius_mm": "reduced radius",
    "line_load_N_mm": "load per width",
    "entrainment_speed_m_s": "mean speed of the surfaces",
    "slide_roll_ratio": "sliding speed over entrainment speed",
    "oil_temperature_C": "temperature of the oil at the inlet",
}
STATUS = "text: converged, or why there is no solution"
REGIME = {
    "hertz_pressure_GPa": "largest Hertz pressure",
    "moes_load": "Moes' load parameter M",
    "moes_material": "Moes' material parameter L",
    "speed_parameter": "viscosity times entrainment speed over reduced modulus and radius",
    "load_parameter": "line load over reduced modulus and radius",
}
EXPONENTS = {f"{name}_exponent": f"exponent of the {name}" for name in ("speed", "load", "sliding", "pressure")}
LEFT = "root mean square of the logarithm that factor and exponents leave"
RATIO = "text: full solution over base law, or Eyring stress, that is fitted"
LAW_ERRORS = {
    "laws": described(
        law="text: law",
        oil="text: oil, or all",
        contacts="contacts with a solution",
        not_positive="of them, contacts where the law gives nothing or less",
        median_ratio="law over full solution, median",
        low_ratio_5_percent="law over full solution, 5 % are below",
        high_ratio_95_percent="law over full solution, 5 % are above",
        mean_size_of_log="mean absolute value of its logarithm",
    ),
    "fits": described(
        ratio=RATIO,
        oil="text: oil, or all",
        rigs="rigs with a fit",
        factor="factor in the middle of a rig, geometric mean over rigs",
        factor_sd_of_log="standard deviation of its logarithm over rigs",
        **EXPONENTS,
        **{f"{name}_sd": f"standard deviation over rigs: {words}" for name, words in EXPONENTS.items()},
        left_rms_of_log=LEFT,
        overall_rms_of_log="the same of one fit to all contacts",
    ),
    "rigs": described(
        ratio=RATIO,
        **OF_OIL,
        contacts="contacts of the fit",
        factor="factor in the middle of the rig",
        **EXPONENTS,
        left_rms_of_log=LEFT,
    ),
    "ratios": described(**OF_OIL, **CONDITIONS, **REGIME, LAWNAME="law over full solution"),
    "fitted": described(
        **OF_OIL,
        **CONDITIONS,
        **REGIME,
        isothermal_stress_Pa="mean shear stress of the isothermal solution",
        eyring_stress_Pa="Eyring stress of the oil",
        solved_rate_Pa="viscosity of the oil times shear rate, with the solved film",
        base_rate_Pa="the same with film and viscosity of the base model",
        RATIO="full solution over its law",
    ),
    "solutions": described(
        **OF_OIL,
        **CONDITIONS,
        isothermal_status=STATUS,
        thermal_status=STATUS,
        WAYS_central_film_nm="film thickness in the centre of the contact",
        WAYS_minimum_film_nm="smallest film thickness",
        WAYS_flow_film_nm="mass flow over density and entrainment speed",
        WAYS_friction="friction coefficient",
        WAYS_rolling_W_m="heat of shear per width that is not of sliding",
        WAYS_film_error_percent="estimated error of the central film",
        WAYS_friction_error_percent="estimated error of the friction coefficient",
        thermal_wall_rise_K="mean of the largest rises of both walls above the oil",
    ),
}
INPUTS = {
    "hertz_pressure_GPa": "largest Hertz pressure",
    "slide_roll_ratio": "sliding speed over entrainment speed, without sign",
    "entrainment_speed_m_s": "mean speed of the surfaces",
    "viscosity_mPa_s": "viscosity of the oil at its temperature",
    "radius_mm": "reduced radius",
}
"""Inputs of a regression of friction."""
TERM = {
    "term": "text: logarithms of inputs that are multiplied",
    "coefficient": "text: name of the coefficient in the file of the law",
    "value": "value of the coefficient",
    "standard_error": "standard error of the coefficient",
    "t": "value over standard error",
}
FITTED = {"fitted": "friction coefficient by the law", "residual_of_log": "logarithm of friction less that by the law"}
CONDENSED = {
    "solutions": described(
        **INPUTS,
        oil_temperature_C="temperature of the oil at the inlet",
        sliding="text: surface that is faster",
        friction="friction coefficient of the full solution",
        friction_error_percent="its estimated error",
        status=STATUS,
        **FITTED,
        left_out="whether the solution is left out of the fit",
    ),
    "terms": described(**TERM),
    "against_published": described(
        **INPUTS,
        condensed_friction="friction coefficient by the condensed law",
        published_friction="friction coefficient by the law of Xu and Kahraman",
        published_over_condensed="published over condensed",
    ),
}
