"""Made-up instrument files of several kinds of recording, small, with and without a planted effect."""

import numpy as np


def table(header, rows, separator=","):
    return separator.join(header) + "\n" + "".join(separator.join(map(str, row)) + "\n" for row in rows)


def driven_and_back_driven():
    """Friction of a geared drive: more with load, most where the load drives."""
    rows = []
    for speed in (-30, -15, -5, 5, 15, 30):
        for load in (-80, -60, -40, -20, 0, 20, 40, 60, 80):
            driven = np.sign(speed * load)
            friction = np.sign(speed) * (2.0 + 0.03 * abs(speed) + 0.15 * abs(load) * (1 - 0.25 * driven))
            rows.append((speed, load, round(friction * (1 + 0.01 * np.cos(7.0 * len(rows))), 5)))
    return table(("speed_rpm", "torque_Nm", "friction_torque_Nm"), rows)


def running_in():
    """Friction coefficient of a pin on a disc that falls with time."""
    time = np.arange(2, 1200, 12)
    friction = 0.16 + 0.05 * np.exp(-time / 300.0) + 0.0006 * np.cos(11.0 * time)
    return table(("time_s", "friction_coefficient"), zip(time, friction.round(6), strict=True))


def accelerated():
    """Torque of a motor that brings a fly-wheel up to speed: friction and inertia."""
    time = np.arange(0, 60, 0.5)
    speed = 800 * (1 - np.exp(-time / 12.0))
    torque = 0.25 + 2e-4 * speed + 0.004 * np.gradient(speed, time) + 0.002 * np.cos(13.0 * time)
    return table(("time_s", "speed_rpm", "friction_torque_Nm"), zip(time, speed.round(4), torque.round(6), strict=True))


def viscosities():
    """Viscosity of a liquid by two laboratories over temperature and pressure."""
    rows = []
    for setup, gain in (("A", 1.0), ("B", 1.01)):
        for temperature in (40, 60, 80):
            for pressure in (0.1, 50, 100, 200):
                viscosity = gain * 5.1 * np.exp(-0.02 * (temperature - 40)) * np.exp(0.0125 * pressure)
                scattered = viscosity * (1 + 0.005 * np.cos(5.0 * len(rows)))
                rows.append((setup, temperature, pressure, round(scattered, 5), round(0.008 * viscosity, 5)))
    return table(("setup", "temperature_C", "pressure_MPa", "viscosity_mPa_s", "viscosity_mPa_s_sd"), rows)


def films():
    """Film of a ball on glass over speed, thinner than the formulas at the highest speeds."""
    rows = []
    for load in (20, 40):
        for speed in np.geomspace(0.02, 2.0, 10):
            film = 200 * speed**0.67 * (load / 20) ** -0.067 / (1 + 0.15 * speed**1.2)
            scattered = film * (1 + 0.01 * np.cos(3.0 * len(rows)))
            rows.append((load, round(speed, 5), 0, 40, round(scattered, 3)))
    header = ("load_N", "entrainment_speed_m_s", "slide_roll_ratio", "oil_temperature_C", "film_thickness_nm")
    return table(header, rows)


def german():
    """Drive of a German rig: title, semicolons, decimal commas, units in the second row, a dead sensor, a footer."""
    lines = ["Prüfstand 4;;;;;", "Datum: 12.03.2024;;;;;"]
    lines += ["Nr.;Drehzahl;Lastmoment;Öltemperatur;Reibmoment;Fühler 7", ";1/min;Nm;°C;Nm;V"]
    for count, line in enumerate(driven_and_back_driven().splitlines()[1:], start=1):
        speed, load, friction = line.split(",")
        lines.append(f"{count};{speed},0;{load},0;40,0;{friction.replace('.', ',')};0,000")
    return "\n".join([*lines, ";;;;;", "Ende der Messung;;;;;"]) + "\n"


MADE_UP = {one.__name__: one for one in (driven_and_back_driven, running_in, accelerated, viscosities, films, german)}
