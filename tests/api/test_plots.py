"""Plots from Python: figures of a study and residuals of an answer hold the numbers of their source."""

import matplotlib.pyplot as plt
import numpy as np
import pytest

import mixedlub as ml
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


def test_only_results_of_a_study_are_drawn(results) -> None:
    with pytest.raises(InputError, match=r"ml\.study\.run"):
        ml.plot(results.to_xarray())


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
