"""Plots from Python: figures of a study and residuals of an answer hold the numbers of their source."""

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest

import mixedlub as ml
from mixedlub.efficiency import EXAMPLE
from profiles.errors import InputError


@pytest.fixture(scope="module")
def results(two_flanks):
    return ml.study.run(two_flanks(torque_Nm="[50, 100]", speed_rpm="[3000, 500, 1500]", oil_temperature_C="[90, 40]"))


@pytest.fixture(autouse=True)
def _closed():
    yield
    plt.close("all")


def drawn(panel) -> list[np.ndarray]:
    return [line.get_ydata() for line in panel.lines if len(line.get_xdata()) > 1]


@pytest.mark.parametrize("quantity", ["power_loss_W", "boundary_area_ratio", "film_parameter"])
def test_curves_over_speed_are_the_columns(results, quantity: str) -> None:
    figure = ml.plot(results, quantity, oil_temperature_C=90, pairings=["polished / polished", "ground / polished"])
    data = results.to_xarray()[quantity].sel(oil_temperature_C=90).sortby("speed_rpm")
    panels = [axes for axes in figure.axes if drawn(axes)]
    assert len(panels) == 2
    for panel, pairing in zip(panels, (2, 1), strict=True):
        for line, torque in zip(drawn(panel), (50, 100), strict=True):
            np.testing.assert_allclose(line, data.isel(pairing=pairing).sel(torque_Nm=torque).values)
    assert panels[0].get_xlabel() == "pinion speed (rpm)"
    assert panels[0].get_title(loc="left").startswith("polished / polished")


def test_without_a_choice_equal_surfaces_are_drawn_at_the_lowest_temperature(results) -> None:
    panels = [axes for axes in ml.plot(results).figure.axes if drawn(axes)]
    data = results.to_xarray()["power_loss_W"].sel(oil_temperature_C=40, torque_Nm=50).sortby("speed_rpm")
    np.testing.assert_allclose(drawn(panels[0])[0], data.isel(pairing=2).values)
    np.testing.assert_allclose(drawn(panels[1])[0], data.isel(pairing=0).values)


def test_over_temperature_it_is_the_loss_at_the_highest_speed(results) -> None:
    panel = ml.plot(results, over="oil_temperature_C", pairings=["ground / ground"]).axes[0]
    data = results.to_xarray()["power_loss_W"].isel(pairing=0).sel(speed_rpm=3000, torque_Nm=50)
    np.testing.assert_allclose(drawn(panel)[0], data.sortby("oil_temperature_C").values)


@pytest.mark.parametrize("over", ["composite_roughness_um", "film_parameter", "boundary_area_ratio"])
def test_the_loss_over_a_column_has_a_point_a_pairing(results, over: str) -> None:
    figure = ml.plot(results, over=over, oil_temperature_C=90)
    at = results.to_xarray().sel(oil_temperature_C=90, torque_Nm=50)
    points = np.array(
        [(x, y) for line in figure.axes[0].lines if line.get_marker() == "o" for x, y in line.get_xydata()]
    )
    expected = np.column_stack([at[over].values.ravel(), at["power_loss_W"].values.ravel()])
    np.testing.assert_allclose(points[np.lexsort(points.T)], expected[np.lexsort(expected.T)])


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ({"quantity": "power_los"}, "nearest known: 'power_loss_W'"),
        ({"over": "speed"}, "nearest known: 'speed_rpm'"),
        (
            {"quantity": "film_parameter", "over": "oil_temperature_C"},
            "only power_loss_W is drawn over oil_temperature_C",
        ),
        ({"oil_temperature_C": 60}, "known: 40, 90"),
        ({"over": "oil_temperature_C", "oil_temperature_C": 40}, "leave it out"),
        ({"pairings": ["ground / polish"]}, "nearest known: 'ground / polished'"),
        ({"pairings": "ground / ground", "over": "film_parameter"}, "all pairings"),
    ],
)
def test_what_cannot_be_drawn_is_refused(results, keys, said: str) -> None:
    with pytest.raises(InputError, match=said.replace("(", r"\(")):
        ml.plot(results, **keys)


PAIR = {"teeth": (17, 26), "normal_module_mm": 4.2333, "pressure_angle_deg": 22.5, "face_width_mm": 14.0}


def loss_over(**conditions):
    rough = ml.surface(m0_um2=0.137, m2=0.0031, m4_per_um2=0.0021)
    with pytest.warns(ml.CautionWarning):
        return ml.power_loss(ml.gear_pair(**PAIR), ml.oil("mineral"), rough, **conditions)


def test_an_array_is_drawn_over_its_longest_dimension_with_a_line_for_each_level() -> None:
    loss = loss_over(torque_Nm=[50, 100], speed_rpm=[500, 1500, 3000], oil_temperature_C=60)
    (panel,) = ml.plot(loss).axes
    lines = [line for line in panel.lines if line.get_linestyle() == "-"]
    for line, torque in zip(lines, (50, 100), strict=True):
        np.testing.assert_allclose(line.get_ydata(), loss["power_loss_W"].sel(torque_Nm=torque))
    assert (panel.get_xlabel(), panel.get_ylabel()) == ("speed (rpm)", "power loss (W)")
    assert [text.get_text() for text in panel.get_legend().get_texts()] == ["50", "100"]
    hollow = sum(len(line.get_xdata()) for line in panel.lines if str(line.get_markerfacecolor()) == "white")
    assert hollow == int((loss["validity"] != "valid").sum())


def test_a_third_dimension_has_a_panel_for_each_level() -> None:
    loss = loss_over(torque_Nm=[50, 100, 150], speed_rpm=[500, 3000], oil_temperature_C=[40, 60])
    figure = ml.plot(loss, "mean_friction", over="oil_temperature_C")
    assert len(figure.axes) == 2
    assert [panel.get_title(loc="left") for panel in figure.axes] == ["speed 500 rpm", "speed 3000 rpm"]
    assert figure.axes[0].get_xlabel() == "oil temperature (°C)"


def test_the_path_of_contact_and_a_gearbox_are_drawn() -> None:
    path = ml.along_path(
        ml.gear_pair(**PAIR),
        ml.oil("mineral"),
        ml.surface(m0_um2=4e-4, m2=2e-4, m4_per_um2=4e-4),
        torque_Nm=50,
        speed_rpm=3000,
        oil_temperature_C=60,
    )
    (panel,) = ml.plot(path).axes
    np.testing.assert_allclose(panel.lines[0].get_ydata(), path["friction"])
    box = ml.gearbox_efficiency(EXAMPLE)
    lines = ml.plot(box).axes[0].lines
    np.testing.assert_allclose(lines[0].get_ydata(), box["total_loss_W"].isel(torque_Nm=0))
    parts = ml.plot(box, "part_loss_W", over="speed_rpm")
    assert len(parts.axes) >= 2


def test_a_table_is_drawn_as_points(drive) -> None:
    table = ml.simulate(drive, at={"speed_rpm": [10.0, 100.0, 400.0]})
    (panel,) = ml.plot(table).axes
    points = np.concatenate([line.get_xydata() for line in panel.lines])
    np.testing.assert_allclose(np.sort(points[:, 0]), table["speed_rpm"])
    assert (panel.get_xlabel(), panel.get_ylabel()) == ("speed (rpm)", "friction torque (N m)")


def test_fitted_laws_are_drawn_beside_the_readings() -> None:
    water = {"temperature_C": [0, 20, 40, 60, 80, 100], "viscosity_mPa_s": [1.792, 1.002, 0.653, 0.466, 0.354, 0.282]}
    fit = ml.fit_laws(water, relative_sd=0.005)
    (panel,) = ml.plot(fit).axes
    readings, *laws = panel.lines
    np.testing.assert_allclose(readings.get_xydata(), np.column_stack(list(water.values())))
    assert [line.get_label() for line in laws] == list(fit.tied)
    np.testing.assert_allclose(laws[0].get_ydata(), water["viscosity_mPa_s"], rtol=0.01)


def test_parts_are_drawn() -> None:
    radius, slide_roll = ml.plot(ml.gear_pair(**PAIR)).axes
    points = ml.gear.mesh(ml.gear.GearPair((17, 26), 4.2333e-3, np.radians(22.5), 14e-3), ml.gear.RigidSharing())
    assert radius.lines[0].get_ydata().max() == pytest.approx(1e3 * points.radius.max())
    slides = points.sliding_per_speed / points.entrainment_per_speed
    assert slide_roll.lines[0].get_ydata().min() == pytest.approx(slides.min())
    viscosity = ml.plot(ml.oil("n100")).axes[0].lines[0]
    at_40 = np.interp(40.0, *viscosity.get_data())
    assert at_40 == pytest.approx(97.9 * 0.88, rel=0.03)
    heights = ml.plot(ml.surface("shipped:0258", cutoff_mm=0.8, short_cutoff_um=2.5)).axes[0].lines[0].get_ydata()
    assert np.mean(np.abs(heights)) == pytest.approx(0.258, rel=0.02)


def test_an_answer_is_drawn_in_one_picture(drive, answer) -> None:
    residuals, probabilities, fit = ml.plot(answer, over="speed_rpm", later=[1.15, 1.20]).axes
    before, after = answer.diagnosis.residuals
    np.testing.assert_allclose(residuals.lines[0].get_ydata(), before)
    np.testing.assert_allclose(residuals.lines[1].get_ydata(), after)
    bars = [patch.get_width() for patch in probabilities.patches]
    assert max(bars) == pytest.approx(max(answer.diagnosis.posterior.weights.values()))
    (later,) = [line for line in fit.lines if line.get_label() == "predicted, then measured"]
    np.testing.assert_allclose(later.get_xydata(), [[150.0, 1.15], [250.0, 1.20]])
    (predicted,) = [one for one in fit.collections if len(one.get_paths()) == 2]
    wanted = answer.diagnosis.wanted
    ends = np.column_stack([wanted.low90, wanted.high90])
    np.testing.assert_allclose([path.vertices[:, 1] for path in predicted.get_paths()], ends)
    assert ml.plot(answer).axes[0].get_xlabel() == "speed (rpm)"


def test_an_answer_over_one_of_several_conditions_is_drawn_one_to_one(answer, monkeypatch) -> None:
    monkeypatch.setattr("mixedlub.diagnosis.report.figures.in_one._alone", lambda *_: False)
    fit = ml.plot(answer, later=[1.15, 1.20]).axes[2]
    lines = {line.get_label(): line for line in fit.lines}
    np.testing.assert_allclose(lines["with the answer"].get_ydata(), answer.diagnosis.readings)
    np.testing.assert_allclose(lines["with the answer"].get_xdata(), answer.diagnosis.recorded.predicted)
    np.testing.assert_allclose(lines["predicted, then measured"].get_xdata(), answer.diagnosis.wanted.predicted)
    assert fit.get_xlabel() == "simulated friction torque (N m)"


@pytest.mark.parametrize(
    ("drawn", "keys", "said"),
    [
        (lambda _: "loss.csv", {}, "must be a result"),
        (lambda _: {"one": pd.DataFrame({"a": [1.0]})}, {}, "choose among one"),
        (lambda a: a, {"over": "sped_rpm"}, "nearest known: 'speed_rpm'"),
        (lambda a: a, {"later": [1.0]}, "each of the 2 conditions of predict"),
        (lambda a: a, {"quantity": "friction"}, "belongs to a study"),
        (lambda a: a.probabilities.to_frame(), {"quantity": "p"}, "known: probability"),
        (lambda _: ml.surface(Ra_um=0.3), {}, "only a trace"),
        (lambda _: ml.oil("mineral"), {"later": [1.0]}, "belongs to an answer"),
    ],
)
def test_other_results_that_cannot_be_drawn_are_refused(answer, drawn, keys, said: str) -> None:
    with pytest.raises(InputError, match=said):
        ml.plot(drawn(answer), **keys)


@pytest.mark.parametrize("over", ["run", "speed_rpm"])
def test_residuals_are_drawn_before_and_after(answer, over: str) -> None:
    axes = plt.figure().add_subplot()
    assert answer.plot_residuals(over, axes) is axes
    before, after = answer.diagnosis.residuals
    x = answer.diagnosis.recorded.table[over]
    for line, values in zip(axes.lines, (before, after), strict=True):
        np.testing.assert_allclose(line.get_xydata(), np.column_stack([x, values]))
    assert axes.get_xlabel() == {"run": "run", "speed_rpm": "speed (rpm)"}[over]
    assert "standard deviations" in axes.get_ylabel()
    names = [text.get_text() for text in axes.get_legend().get_texts()]
    for name, values in zip(names, (before, after), strict=True):
        assert f"rms {np.sqrt(np.mean(values**2)):.2f}" in name
    assert np.std(after) < np.std(before)


def test_residuals_without_axes_go_to_the_current_ones(answer) -> None:
    axes = plt.figure().add_subplot()
    assert answer.plot_residuals() is axes


def test_residuals_over_an_unknown_column_are_refused(answer) -> None:
    with pytest.raises(InputError, match="nearest known: 'speed_rpm'"):
        answer.plot_residuals("speed")
