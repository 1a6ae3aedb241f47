"""Effects and their laws against published numbers and against integrals of the physics they shorten."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import integrate, optimize, stats

from mixedlub.case import reference_rigs
from mixedlub.effects import catalogue
from mixedlub.effects.asperity_plasticity import asperity_plasticity
from mixedlub.effects.dynamic_load import dynamic_load
from mixedlub.effects.elastic_hysteresis import elastic_hysteresis
from mixedlub.effects.film_heating import film_heating
from mixedlub.effects.inlet_shear_heating import inlet_shear_heating
from mixedlub.effects.inlet_shear_thinning import inlet_shear_thinning
from mixedlub.effects.micro_ehl import micro_ehl
from mixedlub.effects.misalignment import misalignment
from mixedlub.effects.rolling_resistance import rolling_resistance
from mixedlub.effects.roughness_lay import roughness_lay
from mixedlub.effects.skewed_heights import _skewed_area_integral
from mixedlub.effects.tip_relief import tip_relief
from mixedlub.effects.torque_offset import torque_offset
from mixedlub.effects.viscosity_temperature_law import viscosity_temperature_law
from mixedlub.kinds.standard import ROUGHNESS_UM
from mixedlub.laws import drag, heating, loss
from mixedlub.laws.film import wave_amplitude
from mixedlub.report.effect_pages import shown
from mixedlub.rig.lubricant import Lubricant
from roughness.integrals import area_integral

PROTOTYPE = {
    "roughness_lay": {"lay": 1.0, "onset": 0.15, "decay": 1.0, "saturation": 0.0},
    "micro_ehl": {"viscous": 1.0, "texture": 1.0},
    "bearing_drag": {"strength": 1.0, "load_power": 1.0, "rolling_power": 0.0, "rubbing": 0.0},
    "boundary_film_temperature": {"flash": 0.0},
}
"""Parameters of the prototype where they are not the middle of the priors: h + 0.15 sigma, all moments
alike, Palmgren's bearings, a film as warm as the oil."""


def goksem(radius: float, modulus: float, viscosity: float, speed: float, alpha: float) -> float:
    """Force per length of Goksem and Hargreaves, 4.318 (G U)^0.658 W^0.0126 R/alpha, at W = 1.14e-4."""
    return 4.318 * (alpha * viscosity * speed / radius) ** 0.658 * 1.14e-4**0.0126 * radius / alpha


class TestLiterature:
    @pytest.mark.parametrize(("wavelength", "left"), [(1.0, 0.183), (0.5, 0.394), (0.25, 0.660), (0.125, 0.839)])
    def test_amplitude_of_waves_in_a_line_contact(self, wavelength: float, left: float) -> None:
        """Solutions of Venner, Couhier, Lubrecht and Greenwood (1997), M 100, L 11, for a tenth of the film."""
        assert wave_amplitude(wavelength, 100.0, 11.0) == pytest.approx(left, rel=0.05)

    def test_each_surface_is_flattened_by_its_own_waves(self) -> None:
        """The long waves of the first surface go, the short ones of the second stay."""
        here = {"hertz_half_width": 0.18e-3, "hertz_pressure": 1e9, "radius": 8e-3, "reduced_modulus": 226e9}
        oil = {"viscosity": 0.015, "entrainment_speed": 1.0, "pressure_viscosity": 15e-9}
        shares = {"height_share": 0.5, "slope_share": 1e-4, "curvature_share": 1e-8}
        form = {"relative_wavelength": 1.0, "viscous": 1.0, "texture": 1.0}
        m0, m2, m4 = micro_ehl(1e-14, 1e-2, 1e9, **shares, **here, **oil, **form)
        assert m0 / 1e-14 == pytest.approx(0.5, abs=0.05)
        assert m2 / 1e-2 == pytest.approx(1.0, abs=0.1)
        assert m4 / 1e9 == pytest.approx(1.0, abs=0.1)

    """Published numbers, at the tolerance they support."""

    @pytest.mark.literature(
        "Gupta, Cheng, Zhu, Forster and Schrand (1992), Tribol. Trans. 35, 269, doi:10.1080/10402009208982117"
    )
    @pytest.mark.parametrize(
        ("loading", "sliding", "factor"),
        [
            (0.1, 0.0, 0.930),
            (1.0, 0.0, 0.770),
            (10.0, 0.0, 0.428),
            (0.1, 0.5, 0.878),
            (1.0, 0.5, 0.631),
            (10.0, 0.5, 0.267),
        ],
    )
    def test_inlet_heating_of_gupta(self, loading: float, sliding: float, factor: float) -> None:
        gupta = {"strength": 1.0, "sliding": 1.0, "loading_power": 0.64, "pressure_power": 0.0}
        found = inlet_shear_heating(1.0, 1.0, loading, 1.0, 1.0, sliding, 0.005, 1.0, **gupta)
        assert found == pytest.approx(factor, rel=0.03)

    @pytest.mark.literature("Diab, Ville, Velex and Changenet (2004), J. Mech. Des. 126, 903")
    @pytest.mark.parametrize(
        ("diameter", "width", "teeth", "rpm", "watts"),
        [(0.1, 0.02, 25, 10_000, 114), (0.2794, 0.0284, 44, 10_000, 5390), (0.288, 0.03, 72, 6685, 1710),
         (1.16, 0.19, 72, 1000, 6980)],
    )  # fmt: skip
    def test_windage_of_diab(self, diameter: float, width: float, teeth: int, rpm: float, watts: float) -> None:
        found = drag.windage_diab(diameter / 2, rpm * np.pi / 30, width, float(teeth))
        assert found == pytest.approx(watts, rel=0.05)

    @pytest.mark.parametrize("largest", [5.0, 100.0, 5000.0])
    def test_torque_offset_is_that_of_a_meter_as_large_as_the_test(self, largest: float) -> None:
        """Meters keep their zero to 0.05 % of their range."""
        typical = catalogue()["torque_offset"].parameters[0].prior.value(np.arcsinh(1.0))
        assert torque_offset(0.0, 1.0, largest, offset=typical) == pytest.approx(5e-4 * largest, rel=1e-9)

    def test_windage_is_above_a_smooth_disc_in_air(self) -> None:
        """Two faces of a turbulent disc, 0.073 Re^-0.2 rho omega^3 R^5, bound it from below."""
        omega, radius = 1000.0, 0.14
        reynolds = drag.AIR_DENSITY * omega * radius**2 / drag.AIR_VISCOSITY
        disc = 0.073 * reynolds**-0.2 * drag.AIR_DENSITY * omega**3 * radius**5
        assert drag.windage_diab(radius, omega, 0.028, 44.0) > disc

    @pytest.mark.literature("Changenet and Velex (2007), J. Mech. Des. 129, 128")
    @pytest.mark.parametrize(("rpm", "watts"), [(1000, 5.8), (2000, 17), (3000, 33), (5000, 74)])
    def test_churning_of_changenet_and_velex(self, rpm: float, watts: float) -> None:
        found = drag.churning_changenet_velex(0.05, rpm * np.pi / 30, 0.02, 4e-3, 25.0, 50e-6 * 850, 850.0)
        assert found == pytest.approx(watts, rel=0.03)

    @pytest.mark.literature("Palmgren (1964), Grundlagen der Waelzlagertechnik; ISO/TR 14179-2")
    def test_palmgren_joins_its_two_ranges(self) -> None:
        """160e-7 f0 d^3 below nu n of 2000 mm^2/s rpm."""
        slow = drag.palmgren_idle_torque(1e-6 * 850, 850.0, np.pi / 30, 0.045)
        assert slow == pytest.approx(160e-7 * 2 * 45**3 * 1e-3, rel=0.01)

    @pytest.mark.literature("Goksem and Hargreaves (1978), J. Lubr. Technol. 100, 346, doi:10.1115/1.3453183")
    @pytest.mark.parametrize("speed", [1.0, 2.2, 5.0])
    def test_rolling_near_goksem_and_hargreaves(self, speed: float) -> None:
        """4.318 (G U)^0.658 W^0.0126 R/alpha; the two laws meet within 40 % at gear conditions."""
        contact = (8.3262e-3, 226.374e9, 0.01489, speed, 14.81e-9)
        found = rolling_resistance(0.0, *contact, strength=1.0, exponent=0.75)
        assert found == pytest.approx(goksem(*contact), rel=0.4)

    @pytest.mark.literature("Goksem and Hargreaves (1978), J. Lubr. Technol. 100, 346, doi:10.1115/1.3453183")
    @pytest.mark.parametrize("speed", [1.0, 2.2, 5.0])
    @pytest.mark.parametrize("alpha", [8e-9, 14.81e-9, 25e-9])
    def test_rolling_with_their_power_of_speed_is_that_of_goksem_and_hargreaves(
        self, speed: float, alpha: float
    ) -> None:
        contact = (8.3262e-3, 226.374e9, 0.01489, speed, alpha)
        found = rolling_resistance(0.0, *contact, strength=1.0, exponent=0.658)
        assert found == pytest.approx(goksem(*contact), rel=0.03)

    @pytest.mark.literature(
        "Biboulet and Houpert (2010), Proc. IMechE J 224, 765, doi:10.1243/13506501JET790; "
        "Goksem and Hargreaves (1978), J. Lubr. Technol. 100, 346, doi:10.1115/1.3453183; "
        "Zhou and Hoeprich (1991), J. Tribol. 113, 590, doi:10.1115/1.2920664; "
        "Pan and Hamrock (1989), J. Tribol. 111, 246, doi:10.1115/1.3261900"
    )
    @pytest.mark.parametrize(("power", "published"), [(0.75, 0.0), (0.658, -0.342), (0.648, -0.352), (0.638, -0.358)])
    def test_rolling_falls_with_the_published_powers_of_alpha(self, power: float, published: float) -> None:
        """Biboulet and Houpert; Goksem and Hargreaves; Zhou and Hoeprich; Pan and Hamrock."""
        stiff, soft = (
            rolling_resistance(0.0, 0.01, 226e9, 0.015, 2.0, alpha, strength=1.0, exponent=power)
            for alpha in (20e-9, 10e-9)
        )
        assert np.log2(stiff / soft) == pytest.approx(published, abs=0.03)

    @pytest.mark.literature(
        "Patir and Cheng (1978), J. Lubr. Technol. 100, 12, doi:10.1115/1.3453103; "
        "Tripp (1983), J. Lubr. Technol. 105, 458, doi:10.1115/1.3254641"
    )
    def test_lay_of_a_film_below_the_range_of_flow_factors_stays_what_it_was_there(self) -> None:
        """Patir and Cheng give them for h/sigma above 0.5; a = 0.5, k = 2 is Tripp's 1 + 3/H^2 to first order."""
        ridges = {"lay": 0.5, "onset": 6.0**0.5, "decay": 2.0, "saturation": 0.5}
        gone, thick = (roughness_lay(h, 1.0, **ridges) / h for h in (1e-9, 20.0))
        assert gone == pytest.approx((1.0 + 6.0 / 0.25) ** 0.5, rel=1e-6)
        assert thick == pytest.approx(1.0 + 3.0 / 20.0**2, rel=1e-4)


class TestStandardGear:
    """The standard gear against an independent prototype of it."""

    @pytest.mark.parametrize(
        ("effect_id", "torque", "speed"),
        [
            ("inlet_shear_heating", 0.8, 2.4),
            ("film_heating", 1.5, 1.7),
            ("coating_insulation", 1.35, 1.8),
            ("rolling_resistance", 0.0, 1.75),
            ("windage", 0.0, 2.75),
            ("bearing_drag", 0.6, 1.3),
            ("elastic_hysteresis", 1.5, 1.0),
            ("micro_ehl", 1.1, 0.75),
            ("asperity_plasticity", 1.0, 0.5),
            ("roughness_lay", 0.8, 0.9),
            ("boundary_film_temperature", 1.1, 0.4),
            ("surface_defects", 0.9, 1.0),
            ("tip_relief", 0.67, 0.96),
            ("torque_offset", 0.0, 1.0),
            ("sensor_gain", 1.17, 0.93),
        ],
    )
    def test_powers_of_torque_and_speed_on_the_standard_gear(self, effect_id: str, torque: float, speed: float) -> None:
        """Exponents of the change of loss that an independent prototype of this gear gave; they are good to 0.3."""
        forward = reference_rigs.forward("gear_pair")
        values = shown(catalogue()[effect_id]) | PROTOTYPE.get(effect_id, {})
        change = np.abs(forward.predict(None, {effect_id: values}) - forward.predict())
        rows = change > 1e-9 * change.max()
        table = forward.table
        columns = [np.ones(rows.sum()), np.log(table["torque_Nm"][rows]), np.log(table["speed_rpm"][rows])]
        temperature = table["oil_temperature_C"][rows] / 10.0
        rough = [table["pinion_surface"][rows] == s for s in ROUGHNESS_UM]
        design = np.array([*columns[1:], temperature, *rough], dtype=float).T
        powers, *_ = np.linalg.lstsq(design, np.log(change[rows]), rcond=None)
        assert powers[0] == pytest.approx(torque, abs=0.3)
        assert powers[1] == pytest.approx(speed, abs=0.3)


class TestIntegrals:
    """Closed forms and iterations against the integrals and equations behind them."""

    @pytest.mark.parametrize("skewness", [-2.0, -0.8, -0.05, 0.05, 0.6, 1.5])
    @pytest.mark.parametrize("gap", [-1.5, 0.0, 1.0, 2.2])
    def test_skewed_area_integral_is_that_of_lognormal_heights(self, skewness: float, gap: float) -> None:
        def skew(shape: float) -> float:
            return float(stats.lognorm(shape).stats(moments="s")) - abs(skewness)

        law = stats.lognorm(optimize.brentq(skew, 1e-4, 2.0, xtol=1e-14))
        side = np.sign(skewness)
        mean, sd = law.mean(), law.std()

        def excess(height: float) -> float:
            return max(side * (height - mean) / sd - gap, 0.0) * law.pdf(height)

        edge = mean + side * gap * sd
        ends = (max(edge, 0.0), np.inf) if side > 0 else (0.0, max(edge, 0.0))
        expected = integrate.quad(excess, *ends, limit=200, epsabs=1e-13)[0]
        assert _skewed_area_integral(np.array(gap), skewness) == pytest.approx(expected, abs=1e-8)

    def test_skewed_area_integral_joins_the_normal_one(self) -> None:
        gaps = np.linspace(-2.0, 3.0, 11)
        below, above = (_skewed_area_integral(gaps, s) for s in (-0.99999e-4, -1.00001e-4))
        np.testing.assert_allclose(below, above, atol=2e-9)
        np.testing.assert_allclose(_skewed_area_integral(gaps, 0.0), area_integral(gaps), rtol=1e-15)

    def test_plastic_area_is_the_sum_over_asperities(self) -> None:
        """Each summit has pi R w below onset w_c and pi R w (2 - w_c/w) above."""
        gap, onset = 0.7, 0.4
        radius, sigma, density, modulus = 1e-5, 1e-7, 1e10, 226e9
        hardness = np.sqrt(onset * sigma / radius) * modulus / (np.pi * 0.577)

        def area(height: float) -> float:
            w = height - gap
            return (w if w < onset else 2.0 * w - onset) * stats.norm.pdf(height)

        expected = np.pi * density * radius * sigma * integrate.quad(area, gap, 12.0, points=[gap + onset])[0]
        elastic = np.pi * density * radius * sigma * area_integral(gap)
        found = asperity_plasticity(elastic, gap, density, radius, sigma, modulus, strength=1.0, hardness=hardness)
        assert found == pytest.approx(expected, rel=1e-6)

    def test_hysteresis_loses_its_share_of_the_work_of_the_front_half(self) -> None:
        """Surfaces a distance x before the middle of a Hertz line contact close at the speed x u/R."""
        load, width, radius, speed = 200e3, 0.15e-3, 8.3e-3, 3.0
        peak = 2.0 * load / (np.pi * width)

        def work(x: float) -> float:
            return peak * np.sqrt(1.0 - (x / width) ** 2) * x * speed / radius

        force = elastic_hysteresis(0.0, load, width, radius, loss_fraction=0.01)
        lost = loss.rolling_loss(np.full(1, force), np.full(1, speed), 1.0, np.ones(1))
        assert float(lost[0]) == pytest.approx(0.01 * integrate.quad(work, 0.0, width)[0], rel=1e-9)

    @pytest.mark.parametrize("uneven", [1e-4, 9.9e-3, 0.3, 0.999, 1.0, 1.7, 12.0])
    @pytest.mark.parametrize("power", [0.05, 0.17, 0.6])
    def test_misaligned_face_loses_what_its_linear_load_does(self, uneven: float, power: float) -> None:
        """A rigid gap on an even bed of springs: the load is linear along the part of the face that touches."""
        touching = min(1.0, uneven**-0.5)
        highest = 1.0 + uneven if uneven <= 1.0 else 2.0 * uneven**0.5
        lowest = max(1.0 - uneven, 0.0)

        def lost(y: float) -> float:
            return (highest + (lowest - highest) * y / touching) ** (1.0 + power)

        excess = integrate.quad(lambda y: lost(y) - 1.0, 0.0, touching, epsabs=1e-14, epsrel=1e-12)[0] - 1.0 + touching
        gap = uneven * 2.0 * 1e5 / 2e10
        found = misalignment(1.0, 1e5, 1.0, misalignment=gap, relief=1.0, loss_power=power)
        assert np.log(found) == pytest.approx(np.log1p(excess) / power, rel=1e-5)

    def test_misalignment_has_a_limit_for_a_coefficient_that_load_does_not_change(self) -> None:
        """ln w goes to the mean of (1 + xs) ln(1 + xs) over s from -1 to 1."""
        limit = integrate.quad(lambda s: 0.5 * (1.0 + 0.7 * s) * np.log1p(0.7 * s), -1.0, 1.0)[0]
        found = misalignment(1.0, 1e5, 1.0, misalignment=7e-6, relief=1.0, loss_power=0.0)
        assert np.log(found) == pytest.approx(limit, rel=1e-4)

    @pytest.mark.parametrize("ratio", [0.4, 0.95, 1.3])
    @pytest.mark.parametrize("phase", [-1.2, 0.0, 0.9])
    def test_dynamic_load_is_the_steady_vibration_where_the_teeth_slide(self, ratio: float, phase: float) -> None:
        """Driven by cos(r t), the phase of the sliding being pi/2 - phase after the peak of the drive."""
        damping = 0.1

        def motion(t: float, state: np.ndarray) -> list[float]:
            return [state[1], np.cos(ratio * t) - state[0] - 2.0 * damping * state[1]]

        moment = (np.pi / 2 - phase + 2.0 * np.pi * 30) / ratio
        steady = integrate.solve_ivp(motion, (0.0, moment), [0.0, 0.0], rtol=1e-9, atol=1e-11).y[0, -1]
        pair = {"amplitude": 0.02, "resonance": 1.0 / (2.0 * np.pi), "damping": damping, "phase": phase, "second": 0.0}
        assert dynamic_load(1.0, ratio, 1.0, **pair) == pytest.approx(1.0 + 0.02 * ratio * steady, abs=1e-6)

    def test_flash_temperature_integrates_a_moving_source(self) -> None:
        """Mean over the contact of a semi-elliptic flux that one fast body carries off alone, halved between two."""
        width, speed, steel = 0.2e-3, 4.0, (46.0, 7800.0, 470.0)
        effusivity = np.sqrt(np.prod(steel))

        def rise(x: float) -> float:
            def source(s: float) -> float:
                return 2.0 * np.sqrt(max(width**2 - (x - s**2) ** 2, 0.0)) / width

            return integrate.quad(source, 0.0, np.sqrt(x + width))[0] / (effusivity * np.sqrt(np.pi * speed))

        mean = integrate.quad(rise, -width, width)[0] / (2.0 * width)
        per_flux = mean / (np.pi / 4.0) / 2.0
        assert heating.flash_temperature(1.0, width, speed, 0.0, *steel) == pytest.approx(per_flux, rel=5e-3)

    @pytest.mark.parametrize("given", [0.0, 1.5])
    def test_softened_stress_meets_its_own_equation(self, given: float) -> None:
        stress = np.linspace(0.1, 90.0, 40)[:, None] * 1e6
        per_stress = np.geomspace(1e-10, 3e-6, 30)
        found = heating.softened_stress(stress, 5e6, given, per_stress)
        again = 5e6 * np.arcsinh(np.sinh(stress / 5e6) * np.exp(-given - per_stress * found))
        np.testing.assert_allclose(found, again, rtol=2e-3)

    def test_film_rise_is_that_of_a_sheared_sheet(self) -> None:
        """Uniform shear between walls at one temperature warms the film by tau v_s h / (12 k) on average."""
        tau, eyring, slip, film, conductivity = 20e6, 5e6, 3.0, 0.4e-6, 0.14
        oil = {"viscosity": 0.0149, "contact_viscosity": 70.0, "temperature_viscosity": 0.026}
        contact = {"flash_per_friction": 700.0, "hertz_pressure": 1e9, "boundary_friction": 0.1, "area_ratio": 0.0}
        found = film_heating(
            tau, eyring, slip, film, oil_conductivity=conductivity, **oil, **contact,
            strength=0.5, flash=0.0, pressure=1.0,
        )  # fmt: skip
        softening = heating.contact_softening(
            **{k: oil[k] for k in ("temperature_viscosity", "viscosity", "contact_viscosity")}
        )
        rise = -np.log(np.sinh(found / eyring) / np.sinh(tau / eyring)) / softening
        assert rise == pytest.approx(found * slip * film / (12.0 * conductivity), rel=1e-3)

    def test_thinning_grows_with_stress_and_stops_for_a_newtonian_oil(self) -> None:
        oil = {"critical_stress": 5e3, "plateau": 0.0, "stress_rule": 1.0, "onset": 1.0, "sliding": 1.0}
        films = [inlet_shear_thinning(2e-7, 0.015, 2.0, 0.0, index=n, **oil) for n in (1.0, 0.9, 0.7)]
        assert films[0] == 2e-7
        assert films[0] > films[1] > films[2] > 0.2 * films[0]

    @pytest.mark.parametrize(("onset", "times"), [(1.0, 2.0), (2.0, 4.0)])
    def test_loss_of_film_sets_in_with_that_power_of_stress(self, onset: float, times: float) -> None:
        """Far below the critical stress Carreau's and Eyring's viscosities fall with its square."""
        oil = {"index": 0.7, "plateau": 0.0, "stress_rule": 1.0, "onset": onset, "sliding": 0.0}
        lost = [1.0 - inlet_shear_thinning(2e-7, 0.015, 2.0, 0.0, critical_stress=g, **oil) / 2e-7 for g in (4e8, 2e8)]
        assert lost[1] / lost[0] == pytest.approx(times, rel=2e-3)

    def test_sliding_thins_the_inlet_as_far_as_it_has_part_in_its_shear(self) -> None:
        oil = {"index": 0.75, "critical_stress": 5e3, "plateau": 0.0, "stress_rule": 1.0, "onset": 1.0}
        rolling, apart, taking_part = (
            inlet_shear_thinning(2e-7, 0.015, 2.0, slip, **oil, sliding=part)
            for slip, part in ((0.0, 1.0), (1.0, 0.0), (1.0, 1.0))
        )
        assert rolling == apart > taking_part

    @pytest.mark.parametrize("relief", [5e-6, 30e-6])
    def test_relief_hands_load_on_without_losing_any(self, relief: float) -> None:
        inputs = reference_rigs.forward("gear_pair").inputs
        words = ("load_share", "path_fraction", "contact_ratio", "transmitted_force", "contact_width", "face_width")
        before = inputs["load_share"]
        after = tip_relief(*(inputs[w] for w in words), relief=relief, length=0.2, fade=1.0)
        total = ((after - before) * inputs["path_weight"]).sum(axis=-1)
        moved = (np.abs(after - before) * inputs["path_weight"]).sum(axis=-1)
        assert (np.abs(total) < 0.01 * moved).all()

    @pytest.mark.parametrize("divergence", [155.0, 178.15, 195.0])
    @pytest.mark.parametrize("known", [(313.15, 373.15), (353.15, 293.15)])
    def test_liquid_of_vogel_is_met_from_two_of_its_viscosities(
        self, divergence: float, known: tuple[float, float]
    ) -> None:
        """0.065 mPa s exp(900 K/(T - T_c)): 51 mPa s at 40 degC where T_c is 178 K."""

        def vogel(kelvin: np.ndarray) -> np.ndarray:
            return 6.5e-5 * np.exp(900.0 / (kelvin - divergence))

        kinematic = vogel(np.array(known)) / (850.0 * (1.0 - 6.5e-4 * (np.array(known) - 288.15)))
        oil = Lubricant("", known, tuple(kinematic.tolist()), (2e-8, 1e-8), 850.0, 6.5e-4, 5e6, 0.14, 2e3)
        kelvin = np.linspace(263.15, 423.15, 9)
        inputs = oil.inputs(kelvin)
        words = ("first_known_temperature", "second_known_temperature", "known_fall", "fall_from_first")
        law = {"share": 1.0, "convexity": 313.15 / (313.15 - divergence), "fall": 1.0}
        found = viscosity_temperature_law(inputs["viscosity"], kelvin, *(inputs[w] for w in words), **law)
        np.testing.assert_allclose(found, vogel(kelvin), rtol=1e-10)
        departure = np.abs(np.log(inputs["viscosity"] / found))
        assert departure[(kelvin > 313.0) & (kelvin < 373.0)].max() < 0.06

    @pytest.mark.parametrize("spot", [120.0, 178.15, 200.0])
    def test_liquid_of_slotte_is_met_within_3_percent_from_10_to_120_degC(self, spot: float) -> None:
        """(T - T_s)**-n, K. F. Slotte, Wied. Ann. 14 (1881) 13: a power of the temperature above one of no flow."""
        known = np.array([313.15, 373.15])
        kelvin = np.linspace(283.15, 393.15, 12)

        def fall(at: np.ndarray) -> np.ndarray:
            return (
                np.log(10.0) * np.log((at - spot) / (known[0] - spot)) / np.log((known[1] - spot) / (known[0] - spot))
            )

        convexity = 313.15 / (2.0 * (313.15 - spot))
        oil = np.exp(-fall(kelvin))
        found = viscosity_temperature_law(
            oil, kelvin, *known, np.log(10.0), fall(kelvin), share=1.0, convexity=convexity, fall=1.0
        )
        assert np.abs(np.log(found / oil)).max() < 0.03

    def test_exponential_of_reynolds_is_met_exactly(self) -> None:
        kelvin = np.linspace(253.15, 423.15, 9)
        fall = 0.0384 * (kelvin - 313.15)
        found = viscosity_temperature_law(
            0.1 * np.exp(-0.9 * fall),
            kelvin,
            313.15,
            373.15,
            0.0384 * 60.0,
            0.9 * fall,
            share=1.0,
            convexity=0.0,
            fall=1.0,
        )
        np.testing.assert_allclose(found, 0.1 * np.exp(-fall), rtol=1e-12)

    def test_law_of_vogel_leaves_the_two_given_viscosities(self) -> None:
        oil = Lubricant("", (313.15, 373.15), (1e-4, 1.1e-5), (2e-8, 1e-8), 880.0, 6.5e-4, 5e6, 0.14, 2e3)
        kelvin = np.array(oil.temperature)
        inputs = oil.inputs(kelvin)
        words = ("first_known_temperature", "second_known_temperature", "known_fall", "fall_from_first")
        found = viscosity_temperature_law(
            inputs["viscosity"], kelvin, *(inputs[w] for w in words), share=1.3, convexity=2.5, fall=1.0
        )
        np.testing.assert_allclose(found, inputs["viscosity"], rtol=1e-13)
