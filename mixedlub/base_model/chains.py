"""Base chains: the laws and their order, written explicitly."""

from __future__ import annotations

from mixedlub.chain.model import Chain
from mixedlub.laws import contact, drag, film, heating, load, loss, mixture, oil, shear
from roughness.mccool import plane_offset, summit_density, summit_radius, summit_sigma

ASPERITIES: Chain = (
    ("composite_roughness", contact.composite_roughness),
    ("summit_density", summit_density),
    ("summit_radius", summit_radius),
    ("summit_sigma", summit_sigma),
    ("plane_offset", plane_offset),
    ("separation", contact.summit_separation),
    ("area_ratio", contact.real_area_ratio),
    ("asperity_pressure", contact.asperity_pressure),
    ("asperity_load_share", contact.asperity_load_share),
)

FRICTION: Chain = (
    ("flash_per_friction", heating.flash_per_friction),
    ("contact_viscosity", oil.roelands_viscosity),
    ("shear_stress", shear.ree_eyring),
    ("fluid_friction", mixture.fluid_friction),
    ("friction", mixture.tallian_friction),
)

LINE: Chain = (
    ("slide_roll_ratio", load.slide_roll_ratio),
    ("hertz_pressure", contact.line_hertz_pressure),
    ("mean_pressure", contact.mean_hertz_pressure),
    ("hertz_half_width", contact.line_hertz_half_width),
    ("moes_load", film.moes_load),
    ("isoviscous_ratio", film.isoviscous_ratio),
    ("film_thickness", film.dowson_toyoda),
    *ASPERITIES,
    *FRICTION,
    ("rolling_force", load.rolling_force),
)

POINT: Chain = (
    ("slide_roll_ratio", load.slide_roll_ratio),
    ("hertz_pressure", contact.point_hertz_pressure),
    ("mean_pressure", contact.point_mean_pressure),
    ("hertz_half_width", contact.point_hertz_half_width),
    ("isoviscous_ratio", film.point_isoviscous_ratio),
    ("film_thickness", film.hamrock_dowson),
    *ASPERITIES,
    *FRICTION,
)


GEAR_CONTACT: Chain = (("line_load", load.gear_line_load), *LINE)
GEAR_LOSS: Chain = (
    *GEAR_CONTACT,
    ("sliding_power", loss.sliding_power),
    ("mesh_loss", loss.mesh_loss),
    ("mean_friction", loss.mean_friction),
    ("rolling_loss", loss.rolling_loss),
    ("power_loss", loss.power_loss),
    ("bath_acceleration", drag.bath_acceleration),
)
