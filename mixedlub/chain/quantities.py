"""The glossary: name, symbol, unit and meaning of every quantity.

Laws and effects use these names for their arguments; files use the name and a unit for their columns.
"""

from __future__ import annotations

from dataclasses import dataclass

from mixedlub.schema.units import dimension


@dataclass(frozen=True)
class Quantity:
    """An entry of the glossary; ``unit``: SI unit, which fixes the dimension."""

    name: str
    symbol: str
    unit: str
    meaning: str

    @property
    def dimension(self) -> tuple[int, int, int, int]:
        """Powers of kilogram, metre, second and kelvin."""
        return dimension(self.unit)


_TABLE = """
# geometry and motion of the contact
radius                  | R          | m       | reduced radius of curvature of the contact
transverse_radius       | R_y        | m       | reduced radius across the direction of motion (point contact)
entrainment_speed       | u          | m/s     | mean of the two surface speeds
sliding_speed           | v_s        | m/s     | difference of the two surface speeds, without sign
moes_load               | M          | -       | Moes' load parameter of a line contact
isoviscous_ratio        | q_EI       | -       | asymptote of the isoviscous elastic film over the piezoviscous one
first_speed             | v_0        | m/s     | sliding speed at the start of the recording
held_speed              | v_k        | m/s     | sliding speeds held one after the other in a recording
slip_since              | s_k        | m       | slip since each held speed began, at its first reading; 0 before
slip_since_early        | s_o        | m       | the same if it began at the reading before
slide_roll_ratio        | S          | -       | sliding speed over entrainment speed
roll_angle              | theta      | rad     | pinion roll angle of the contact point
path_fraction           | xi         | -       | place along the path of contact, 0 at its start and 1 at its end
mesh_phase              | psi        | -       | base pitches since contact began; at one time equal up to integers
contact_width           | b          | m       | width of the line contact, of one slice of the face where it is sliced
face_width              | b_w        | m       | width of the tooth flank
face_position           | y          | -       | place across the face, 0 to 1
# load
torque                  | T_1        | N m     | torque on the pinion
pinion_speed            | omega_1    | rad/s   | angular speed of the pinion
transmitted_force       | F_t        | N       | force at the base circle, T_1/r_b1
load_share              | s          | -       | share of the transmitted force that this contact point carries
load                    | F          | N       | normal force on the contact
line_load               | w          | N/m     | normal force per length of contact
friction_line_load      | w_f        | N/m     | friction force per width of the contact
path_weight             | dx/p_bt    | -       | quadrature weight along the path of contact
mean_weight             | dx/g       | -       | weight of a plain mean over the path of contact
mean_sliding_speed      | V_s        | m/s     | a quarter of the sum of the sliding speeds at both ends of the path
# bodies
reduced_modulus         | E'         | Pa      | 2/[(1-nu1^2)/E1 + (1-nu2^2)/E2]
hardness                | H          | Pa      | indentation hardness of the softer surface
solid_conductivity      | k_s        | W/(m K) | thermal conductivity of the bodies
solid_density           | rho_s      | kg/m^3  | density of the bodies
solid_heat_capacity     | c_s        | J/(kg K) | specific heat of the bodies
coating_thickness       | t_c        | m       | summed thickness of the coatings on both bodies
coating_conductivity    | k_c        | W/(m K) | thermal conductivity of the coating
# lubricant
oil_temperature         | theta_oil  | K       | temperature of the oil at the inlet
viscosity               | eta_0      | Pa s    | dynamic viscosity at oil temperature and ambient pressure
pressure_viscosity      | alpha      | 1/Pa    | pressure-viscosity coefficient at oil temperature
entering_viscosity      | eta_in     | Pa s    | dynamic viscosity of the oil as it enters
entering_coefficient    | alpha_in   | 1/Pa    | pressure-viscosity coefficient of the oil as it enters
entering_stress         | tau_in  | Pa      | Eyring stress of the oil as it enters
bulk_rise               | D_theta    | K       | rise of the teeth above the entering oil
coefficient_fall        | a_theta    | 1/K     | relative fall of the pressure-viscosity coefficient per kelvin
temperature_viscosity   | beta       | 1/K     | relative fall of viscosity per kelvin
first_known_temperature | theta_1    | K       | temperature of the first of the two given viscosities
second_known_temperature | theta_2  | K       | temperature of the second of the two given viscosities
known_fall              | f_12       | -       | logarithm of the first given viscosity over the second
fall_from_first         | f_1        | -       | logarithm of the first given viscosity over that at hand
lowest_fitted_pressure  | p_f1       | Pa      | lowest Hertz pressure of the readings of the oil's traction part
highest_fitted_pressure | p_f2       | Pa      | highest Hertz pressure of these readings
lowest_fitted_temperature | theta_f1 | K       | lowest oil temperature of these readings
highest_fitted_temperature | theta_f2 | K      | highest oil temperature of these readings
oil_density             | rho        | kg/m^3  | density of the oil
kinematic_viscosity     | nu         | m^2/s   | kinematic viscosity at oil temperature and ambient pressure
oil_conductivity        | k_f        | W/(m K) | thermal conductivity of the oil
oil_heat_capacity       | c_f        | J/(kg K) | specific heat of the oil
pressure_modulus        | A          | Pa      | pressure over the logarithm of the viscosity's rise, at small pressure
modulus_slope           | B          | -       | rise of that modulus with pressure
eyring_stress           | tau_0      | Pa      | stress at which shear stops being Newtonian
# roughness (both surfaces together unless a side is named)
m0                      | m_0        | m^2     | variance of the profile heights
m2                      | m_2        | -       | variance of the profile slopes
m4                      | m_4        | 1/m^2   | variance of the profile curvatures
height_share            | s_0        | -       | share of the first surface in the variance of the heights
slope_share             | s_2        | -       | share of the first surface in the variance of the slopes
curvature_share         | s_4        | -       | share of the first surface in the variance of the curvatures
height_row              | j          | -       | row of the pairing in the contact integrals, -1 for normal heights
first_waves             | i_1        | -       | row of the first surface in the tables of flattened waves
second_waves            | i_2        | -       | row of the second surface in the tables of flattened waves
flattening_rate         | g          | 1/m     | Venner's number of a wave in the film over its length
film_m0                 | m_0'       | m^2     | variance of the heights inside the film
film_m2                 | m_2'       | -       | variance of the slopes inside the film
film_m4                 | m_4'       | 1/m^2   | variance of the curvatures inside the film
film_height_share       | s_0'       | -       | first surface's share of the heights inside the film
film_slope_share        | s_2'       | -       | first surface's share of the slopes inside the film
film_curvature_share    | s_4'       | -       | first surface's share of the curvatures inside the film
peklenik_number         | gamma      | -       | correlation length of heights along the motion over that across it
smooth_film             | h_0        | m       | film thickness if the surfaces were smooth
film_over_roughness     | Lambda     | -       | film thickness over composite roughness at a point of the path
composite_roughness     | sigma      | m       | root of the summed height variances
mean_over_rms           | kappa      | -       | mean over rms roughness, sums of both surfaces
mean_roughness          | Ra         | m       | arithmetic mean roughness, mean of both surfaces
summit_density          | D          | 1/m^2   | summits per area
summit_radius           | R_s        | m       | radius of a summit of mean curvature
summit_sigma            | sigma_s    | m       | standard deviation of summit heights
plane_offset            | z_s        | m       | height of the summits' mean plane above the surface's
# state of the contact
hertz_pressure          | p_0        | Pa      | largest pressure of the smooth dry contact; pressure on a sample
mean_pressure           | p_m      | Pa      | mean pressure of the smooth dry contact
hertz_half_width        | b_H        | m       | half width (line) or radius (point) of the smooth dry contact
regression_film         | h_r        | m       | central film thickness as the regression for smooth contacts has it
regime_film             | h_m        | m       | central film thickness as the formula for all regimes has it
film_regime             | kappa      | -       | 0: film of the regression, 1: of the formula for all regimes
law_film                | h_l        | m       | central film thickness by a law or between two
speed_exponent_change   | delta_u    | -       | what the film's exponent of speed has over that of the law
load_exponent_change    | delta_F    | -       | what the film's exponent of load has over that of the law
middle_flow             | (eta_0 u)_m | N/m    | geometric mean of viscosity times speed in the recording
middle_load             | F_m        | N       | geometric mean of the load in the recording
film_ratio              | r_h     | -       | film of the full solution over the film of the film law
film_ratio_factor       | f_h     | -       | factor on that ratio for the error of the emulator
stress_ratio            | r_tau   | -       | shear stress of the full solution over the stress of the shear law
stress_ratio_factor     | f_tau   | -       | factor on that ratio for the error of the emulator
film_thickness          | h          | m       | central film thickness
separation              | t          | -       | gap to the summits' mean plane over summit sigma
area_ratio              | P_B        | -       | real over nominal contact area, the share of boundary friction
asperity_pressure       | p_a        | Pa      | mean pressure that asperities carry at this gap
asperity_real_pressure  | p_r        | Pa      | mean pressure on the real contact area
asperity_load_share     | L          | -       | share of the load that asperities carry, at most 1
full_load_film          | h_0        | m       | film thickness if the film carried the whole load
sharing_exponent        | k          | -       | power of whole over film load in the growth of a film that carries less
film_load_share         | L_h        | -       | share of the load that the film carries
least_film_share        | L_i        | -       | share of the load below which the film's own contact leaves its regime
flash_per_friction      | theta_mu   | K       | rise of the surfaces by sliding per unit of friction coefficient
flash_temperature       | theta_fl   | K       | largest rise of the surfaces above their bulk in the contact by sliding
film_rise               | theta_f    | K       | rise of the middle of the film above its walls by shear
specific_film           | lambda_GF  | -       | local film thickness over mean roughness by which micropitting is rated
contact_viscosity       | eta_p      | Pa s    | viscosity of the film in the contact; of a sample under pressure
shear_stress            | tau        | Pa      | shear stress of the film
fluid_friction          | mu_E       | -       | friction coefficient of the film
boundary_friction       | mu_B       | -       | friction coefficient of touching asperities
friction                | mu         | -       | friction coefficient of the contact
# what a rig reads
power_loss              | P_L        | W       | power lost, mean over a mesh cycle
nominal_loss            | P_n        | W       | power lost as the base model has it at its nominal calibration
rolling_force           | f_r        | N/m     | tangential force per length on each body that resists rolling
rolling_loss            | P_r        | W       | rolling power lost in the mesh, mean over a mesh cycle
tangential_friction     | mu_t       | -       | tangential force on a body over the load, rolling included
sliding_power           | F v_s      | W       | load times sliding speed at a point of the path, times its weight
sliding_integral        | F v_s      | W       | load times sliding speed, mean over a mesh cycle
load_loss_factor        | H_VL       | -       | load times sliding speed, mean over a mesh cycle, over input power
mesh_loss               | P_m        | W       | sliding power lost in the mesh, mean over a mesh cycle
mean_friction           | mu_m       | -       | mesh loss over load times sliding speed along the path
friction_torque         | T_f        | N m     | friction torque of a drive, or its friction coefficient
coulomb_torque          | T_c        | N m     | dry friction torque of a drive, the same in both directions
viscous_torque          | T_v        | N m     | friction torque that grows with speed, at the reference speed
payload_torque          | T_0        | N m     | constant torque that keeps its sign when the drive turns back
running_friction        | T_r        | N m     | friction torque of the moving parts, signed with the speed
drive_speed             | omega      | rad/s   | signed speed of a drive (m/s where a sliding speed is recorded)
reference_speed         | omega_0    | rad/s   | largest speed of the recording, in the unit of drive_speed
drive_acceleration      | alpha_omega | rad/s^2 | rate at which the speed of a drive changes
inertia_scale           | J_0        | kg m^2  | typical torque of a drive over its largest acceleration
temperature_difference  | theta_d    | K       | oil temperature over the mean of the recording, 0 where unknown
inverse_load            | q_w        | -       | smallest load recorded over the load
log_load                | l_F        | -       | ln of the load over the middle one recorded, 0 where none is told
load_fraction           | q_F        | -       | load on a drive over the largest load of the recording
load_sense              | s_L        | -       | 1 where the motor drives the load, -1 where the load drives, else 0
additive_fraction       | q_a        | -       | content of an additive over the largest content tested
gears_fitted            | chi        | -       | 1 with gears; without: share of friction left, 0 for a gear pair
motor_torque            | T_m        | N m     | torque that the controller computes from the motor current
reference_torque        | T_m0       | N m     | largest motor torque of the recording
drive_angle             | phi        | rad     | angle the drive has turned
pressure                | p          | Pa      | hydrostatic pressure
time                    | t          | s       | time since the start of the recording
sequence                | q          | -       | place in the test programme, 0 at its start and 1 at its end
ageing                  | q_h      | -       | share of the programme's ageing done, at a rate that doubles every 10 K
ambient_temperature     | theta_a    | K       | temperature around the rig
fringe_order            | N          | -       | interference order that the instrument counted
first_fringe_order      | N_0        | -       | lowest interference order of the recording
reading                 | y          | *       | the number the rig records, in the unit of its channel
largest_torque          | T_m        | N m     | largest torque of the recording, for what a torque meter is made for
reading_scale           | y_0        | *       | typical size of the recorded number, for effects given as a share of it
pinion_radius           | r_1        | m       | operating pitch radius of the pinion
gear_radius             | r_2        | m       | operating pitch radius of the gear
gear_speed              | omega_2    | rad/s   | angular speed of the gear
gear_module             | m_n        | m       | normal module
helix_angle             | beta       | rad     | helix angle at the reference circle, without sign
pinion_teeth            | z_1        | -       | teeth of the pinion
gear_teeth              | z_2        | -       | teeth of the gear
contact_ratio           | epsilon_alpha | -       | length of the path of contact over the base pitch
# pitch point, for friction laws that give one value for the whole mesh
working_pressure_angle  | alpha_w    | rad     | working pressure angle in the transverse plane
base_helix_angle        | beta_b     | rad     | helix angle at the base circle
pitch_line_speed        | v_t        | m/s     | circumferential speed at the operating pitch circle
pitch_entrainment_speed | u_C        | m/s     | mean of the two surface speeds at the pitch point
pitch_radius            | rho_C      | m       | reduced radius of curvature at the pitch point
mesh_line_load          | w_m        | N/m     | force at the base circle over face width
load_intensity          | K          | Pa      | load intensity of the flanks, F_t/(b d_w1) times (u+1)/u
pitch_pressure          | p_C        | Pa      | largest Hertz pressure of one pair at the pitch point
pitch_film              | h_C        | m       | central film thickness at the pitch point
pitch_minimum_film      | h_minC     | m       | minimum film thickness at the pitch point
# one wheel, shaft or seal of a gearbox
bath_acceleration       | gamma      | m/s^2   | centrifugal acceleration of the oil that clings to the gear
wheel_radius            | r          | m       | operating pitch radius of one wheel
wheel_speed             | omega      | rad/s   | angular speed of one wheel and its shaft
wheel_teeth             | z          | -       | teeth of one wheel
bearing_diameter        | d_m        | m       | mean diameter of a rolling bearing
seal_diameter           | d          | m       | diameter of the shaft under a seal
heat_flux               | q          | W/m^2   | heat made per nominal contact area
"""


def _read() -> dict[str, Quantity]:
    table = {}
    for line in _TABLE.strip().splitlines():
        if not line.startswith("#"):
            name, symbol, unit, meaning = (part.strip() for part in line.split("|"))
            table[name] = Quantity(name, symbol, unit, meaning)
    return table


GLOSSARY: dict[str, Quantity] = _read()
"""Quantity by name."""

_SHOWN = {"m^2/s": ("mm²/s", 1e6), "m": ("µm", 1e6), "Pa": ("MPa", 1e-6)}
"""Unit of a quantity on pages, and the factor from SI."""
_OWN_UNIT = {"load_intensity": ("N/mm²", 1e-6), "radius": ("mm", 1e3), "pitch_radius": ("mm", 1e3)}


def unit_and_factor(quantity: str) -> tuple[str, float]:
    """Unit of a quantity on pages, and the factor from SI."""
    unit = GLOSSARY[quantity].unit
    return _OWN_UNIT.get(quantity) or _SHOWN.get(unit, (unit, 1.0))
