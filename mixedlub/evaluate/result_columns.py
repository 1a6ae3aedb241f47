"""Columns of the result tables of `mixedlub evaluate`, by evaluation."""

from __future__ import annotations

from mixedlub.schema.result import described, with_interval
from mixedlub.solutions.result_columns import FITTED, INPUTS, TERM

RUN = {"run": "number of the reading"}
GEARS = {
    "torque_Nm": "torque on the pinion",
    "speed_rpm": "speed of the pinion",
    "oil_temperature_C": "temperature of the oil",
}
FLANKS = {"pinion_surface": "text: surface of the pinion", "gear_surface": "text: surface of the gear"}
PITCH_LINE = {"pitch_line_velocity_m_s": "speed at the pitch point"}
RECORDING = {"recording": "text: recording"}
FIT = {"chi_square": "sum of squares of the misfits over their standard deviations", "degrees_of_freedom": "of the fit"}
OF_MESH = with_interval("mean_friction", "mean friction coefficient of the mesh")
OF_MESH_OWN = with_interval("mean_friction", "mean friction coefficient of the mesh", own=True)
LOCAL = with_interval("friction_coefficient", "friction coefficient, positive against the sliding", own=True)
CALORIMETRIC = {
    "loss": (
        *described(**RUN, series="text: load stages with one load-independent loss", **GEARS, **FLANKS, **PITCH_LINE),
        *described(oil_heat_W="heat that the oil takes up"),
        *with_interval("power_loss_W", "loss of the gears, all sources"),
        *described(transmitted_power_W="input power", loss_factor="tooth loss factor of the local load"),
        *with_interval("load_dependent_loss_W", "loss of the mesh, without that at zero load", own=True),
        *described(
            load_dependent_loss_relative_sd_common="relative standard deviation by errors common to all readings"
        ),
        *OF_MESH,
    ),
    "series": (
        *described(series="text: load stages with one load-independent loss", readings="number of readings"),
        *described(speed_rpm="mean speed of the pinion", **PITCH_LINE, oil_inlet_temperature_C="mean temperature"),
        *with_interval("load_independent_loss_W", "loss at zero load", own=True),
        *OF_MESH_OWN,
        *described(**FIT),
    ),
    "budget": described(
        series="text: load stages with one load-independent loss",
        source="text: source of error",
        load_independent_loss_W_sd="part of the standard deviation of the loss at zero load",
        mean_friction_sd="part of the standard deviation of the mean friction coefficient",
    ),
}
FORCES = (
    *with_interval("normal_force_N", "force normal to the flank"),
    *with_interval("friction_force_N", "force along the flank, positive towards its tip"),
)
STRAIN_GAUGE = {
    "forces": (
        *described(
            **RECORDING,
            tooth="instrumented tooth, 1 for the one that enters the mesh first",
            roll_angle_deg="roll angle of the instrumented tooth",
            pinion_roll_angle_deg="roll angle of the pinion",
            single_contact="whether it is the only tooth in contact",
            at_pitch_point="whether it is left out of the mean, as the step at the pitch point is smeared",
            sliding_speed_m_s="speed of the pinion's flank less that of the gear's",
            condition_number="condition number of the influence matrix",
        ),
        *FORCES,
        *LOCAL,
    ),
    "recordings": (
        *described(**RECORDING, **GEARS, revolutions="revolutions of the average"),
        *OF_MESH,
        *described(
            left_out_deg="roll angle about the pitch point that the mean leaves out",
            normal_force_over_nominal="mean normal force of single contact over torque over base radius",
            largest_condition_number="largest condition number of the influence matrix",
            removed_friction_force_N="friction force that recentring takes off, mean over the teeth",
            strain_noise_um_m="standard deviation of the averaged strains",
        ),
    ),
    "influence": described(
        tooth="instrumented tooth",
        gauge="number of the gauge",
        roll_angle_deg="roll angle of the tooth",
        normal_influence_um_m_per_N="strain per normal force",
        friction_influence_um_m_per_N="strain per friction force",
    ),
}
ROLL = {"roll_angle_deg": "roll angle of a pinion tooth"}
OFF_LINE = {
    "friction_force": (
        *described(
            **RECORDING,
            shaft_angle_deg="angle turned since the pulse",
            **ROLL,
            off_line_displacement_um="mean displacement off the line of action",
        ),
        *with_interval("friction_force_N", "friction force of all tooth pairs in contact"),
        *described(fitted_friction_force_N="friction force by the local friction coefficients"),
    ),
    "friction": (*described(**RECORDING, **GEARS, **ROLL), *LOCAL),
    "recordings": (
        *described(**RECORDING, **GEARS, harmonics="harmonics of the mesh that are used"),
        *OF_MESH,
        *described(
            misfit_N="root mean square of force less fitted force",
            coupling_percent="part of a force along the line of action that acts off it",
        ),
    ),
}
DISC = {
    "load_N": "normal force",
    "entrainment_speed_m_s": "mean speed of both surfaces",
    "slide_roll_ratio": "sliding speed over entrainment speed",
    "oil_temperature_C": "temperature of the oil",
}
SIDES = {"surface_1": "text: surface of the first disc", "surface_2": "text: surface of the second disc"}
TRACTION_PART = described(
    parameter="text: key of the traction part in oil.toml",
    value="most probable value, in the unit of the row",
    sd="standard deviation",
    low90="lower end of the 90 % interval",
    high90="upper end of it",
    unit="text: unit of the row",
    told="text: no if the readings leave the number at its prior",
)
TWO_DISC = {
    "traction": (
        *described(**RUN, **SIDES, **DISC, sliding_speed_m_s="speed of the first surface less that of the second"),
        *described(hertz_pressure_MPa="largest Hertz pressure", hertz_half_width_um="half width along the motion"),
        *LOCAL,
    ),
    "sweeps": (
        *described(
            swept="text: condition that varies",
            low="its lowest level",
            high="its highest level",
            readings="number of readings",
            **{f"at_{name}": f"level of another condition: {words}" for name, words in DISC.items()},
            **SIDES,
        ),
        *with_interval("exponent", "d ln friction over d ln condition; of temperature, per kelvin"),
        *described(largest_friction="largest friction coefficient of the sweep"),
    ),
    "traction_part": TRACTION_PART,
}
OF_LAW = {"law": "text: sign of sliding, and surfaces where there are several"}
REGRESSION = {
    "terms": described(
        **OF_LAW,
        **TERM,
        low90="lower end of the 90 % interval",
        high90="upper end of it",
        p_value="p-value, were the term named beforehand",
    ),
    "readings": described(
        **OF_LAW,
        **RUN,
        sliding="text: disc that is faster",
        **INPUTS,
        friction_coefficient="friction over load",
        **FITTED,
        standardised_residual="residual over its standard deviation",
    ),
    "fits": described(
        **OF_LAW,
        readings="number of readings",
        terms="number of terms",
        r_squared="coefficient of determination R²",
        adjusted_r_squared="R² adjusted for the number of terms",
        rms_of_log="root mean square of the residuals of ln friction",
        left_out_rms_of_log="the same of readings that are left out of the fit",
        left_out_parts="parts in which readings are left out",
        bic="Bayesian information criterion",
        **{f"least_{name}": f"smallest value of the readings: {words}" for name, words in INPUTS.items()},
        **{f"largest_{name}": f"largest value of the readings: {words}" for name, words in INPUTS.items()},
        first_less_second_of_log="ln friction with the first disc faster less that with the second",
        signs_p_value="p-value of that difference",
    ),
}
CALIBRATION = {
    "coefficients": described(
        coefficient="text: coefficient of the law",
        status="text: free, at a bound or fixed",
        value="value",
        sd="standard deviation",
        low90="lower end of the 90 % interval",
        high90="upper end of it",
        low_bound="lower bound of the fit",
        high_bound="upper bound of the fit",
    ),
    "readings": described(
        **RUN,
        **GEARS,
        **FLANKS,
        **PITCH_LINE,
        load_dependent_loss_W="measured loss of the mesh",
        calculated_load_dependent_loss_W="loss of the mesh by the law",
        mean_friction="mean friction coefficient from the measured loss",
        calculated_mean_friction="mean friction coefficient by the law",
        calculated_over_measured="calculated over measured loss",
        within_25_percent="whether they agree within 25 %",
    ),
    "fit": described(
        readings="number of readings",
        free_coefficients="number of free coefficients",
        r_squared_of_loss="coefficient of determination R² of the loss",
        r_squared_of_mean_friction="coefficient of determination R² of mean friction",
        within_25_percent="part of the readings within 25 %",
        rms_of_ratio="root mean square of calculated over measured less one",
        **FIT,
    ),
    "correlations": described(
        coefficient="text: free coefficient", COEFFICIENT="correlation of its error with that of another coefficient"
    ),
}
