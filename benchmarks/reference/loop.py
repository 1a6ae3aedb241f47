"""The same physics as a plain NumPy loop over conditions: the reference that the batch engine is timed against."""

from __future__ import annotations

import numpy as np

from mixedlub.study import Study
from roughness.integrals import area_integral


def power_losses(study: Study) -> np.ndarray:
    """Power loss (W) of every condition, one after the other, arrays only along the path."""
    pair, points, oil, levels = study.pair, study.mesh, study.oil, study.file.conditions
    modulus, width = pair.reduced_modulus, pair.face_width * points.face_fraction
    losses = []
    for pinion, gear in study.pairings:
        a, b = study.surfaces[pinion], study.surfaces[gear]
        m0, m2, m4 = a.m0 + b.m0, a.m2 + b.m2, a.m4 + b.m4
        alpha = max(m0 * m4 / m2**2, 1.5)
        density = m4 / (6 * np.pi * np.sqrt(3) * m2)
        summit = 0.375 * np.sqrt(np.pi / m4)
        sigma = np.sqrt((1 - (1 + 16 / np.pi - 3 * np.sqrt(3)) / alpha) * m0)
        offset = 4 * np.sqrt(m0 / (np.pi * alpha))
        for celsius in levels.oil_temperature_C:
            kelvin = np.float64(celsius + 273.15)
            eta, slope = oil.viscosity(kelvin), oil.pressure_coefficient(kelvin)
            for torque in levels.torque_Nm:
                share = points.load_share(torque)
                force = share * torque / pair.base_radius[0]
                load = np.maximum(share, 1e-6) * torque / pair.base_radius[0] / width
                for rpm in levels.speed_rpm:
                    omega = rpm * np.pi / 30
                    u, slide = points.entrainment_per_speed * omega, np.abs(points.sliding_per_speed) * omega
                    p0 = np.sqrt(load * modulus / (2 * np.pi * points.radius))
                    speed = (eta * u / (modulus * points.radius)) ** 0.69
                    weight = (load / (modulus * points.radius)) ** -0.1
                    film = 3.06 * points.radius * (slope * modulus) ** 0.56 * speed * weight
                    log = np.log(eta) + 9.67
                    thick = eta * np.exp(log * ((1 + p0 / 1.96e8) ** (slope * 1.96e8 / log) - 1))
                    fluid = oil.eyring_stress * np.arcsinh(thick * slide / (film * oil.eyring_stress)) / p0
                    touch = np.pi * density * summit * sigma * area_integral((film - offset) / sigma)
                    touch = np.minimum(touch, 1.0)
                    friction = fluid + (study.file.boundary_friction - fluid) * touch
                    losses.append((friction * force * slide * points.weight).sum())
    return np.array(losses).reshape(study.plan.shape)
