"""Figures stay readable whatever the size of the study."""

import pytest

from mixedlub.report.figures import MOST_LEVELS, MOST_PAIRINGS, MOST_PANELS, figures
from mixedlub.study import read_study, run_study


@pytest.fixture(scope="module")
def many(tmp_path_factory):
    from tests.study.conftest import BASE, toml

    surfaces = {f"s{i}": {"m0_um2": 0.01 + 0.006 * i, "m2": 0.0025, "m4_per_um2": 0.0036} for i in range(26)}
    levels = {"from": 10, "to": 200, "count": 9}
    conditions = {"torque_Nm": levels, "speed_rpm": levels, "oil_temperature_C": [40, 60, 80]}
    path = tmp_path_factory.mktemp("many") / "many.toml"
    data = {**BASE, "surfaces": surfaces, "conditions": conditions}
    path.write_text("\n".join(f"{key} = {toml(value)}" for key, value in data.items()))
    return run_study(read_study(path))


def test_many_levels_are_thinned_and_said(many):
    drawn = {d.name: d for d in figures(many)}
    assert {name.rpartition("_")[2] for name in drawn} == {"40C", "80C"}
    panels = [a for a in drawn["power_loss_equal_40C"].figure.axes if a.lines]
    assert len(panels) == MOST_PANELS
    assert all(len(a.lines) == MOST_LEVELS for a in panels)
    assert f"{MOST_PAIRINGS} of 351 pairings" in drawn["loss_over_roughness_40C"].caption


def test_captions_say_which_levels_are_drawn(many, write_study):
    drawn = {d.name: d.caption for d in figures(many)}
    torques, speeds = "Drawn are 6 of 9 torques: 10, ", "Drawn are 6 of 9 speeds: 10, "
    for name in ("loss_over_roughness", "loss_over_film_parameter", "loss_over_area_ratio"):
        assert "Drawn are 3 of 9 torques: 10, 105 and 200 Nm." in drawn[f"{name}_40C"]
        assert speeds in drawn[f"{name}_40C"]
    assert "fitted at each torque and speed drawn" in drawn["loss_over_roughness_40C"]
    for name in ("power_loss_equal", "film_and_friction"):
        assert torques in drawn[f"{name}_40C"]
        assert "speeds:" not in drawn[f"{name}_40C"]
    assert not any("Drawn" in d.caption for d in figures(run_study(read_study(write_study()))))


def test_axes_carry_quantity_and_unit(many):
    for drawn in figures(many):
        labels = {a.get_xlabel() for a in drawn.figure.axes} | {a.get_ylabel() for a in drawn.figure.axes}
        assert all("(" in label for label in labels if label), drawn.name


def test_without_equal_pairings_others_take_their_place(write_study):
    study = read_study(write_study(pairings={"pinion": ["fine"], "gear": ["mid", "coarse"]}))
    assert any(d.name.startswith("power_loss_equal") for d in figures(run_study(study)))


def test_levels_in_any_order_are_drawn_from_low_to_high(write_study):
    levels = {"conditions__speed_rpm": [3000, 500, 1500], "conditions__torque_Nm": [150, 50]}
    results = run_study(read_study(write_study(**levels)))
    for drawn in figures(results):
        for panel in drawn.figure.axes:
            for line in panel.lines if "speed" in panel.get_xlabel() else ():
                assert list(line.get_xdata()) == [500, 1500, 3000], drawn.name
        if drawn.name.startswith("power_loss"):
            (legend,) = drawn.figure.legends
            assert [text.get_text() for text in legend.get_texts()] == ["50 Nm", "150 Nm"]


def test_long_names_stay_within_their_panels(write_study):
    moments = {"m0_um2": 0.02, "m2": 0.0025, "m4_per_um2": 0.0036}
    surfaces = {f"superfinished $ vibratory, batch {i}": moments for i in range(3)}
    results = run_study(read_study(write_study(surfaces=surfaces)))
    for drawn in figures(results):
        drawn.figure.draw_without_rendering()
        shown = [panel for panel in drawn.figure.axes if panel.get_title(loc="left")]
        boxes = [panel._left_title.get_window_extent() for panel in shown]
        assert not any(a.overlaps(b) for i, a in enumerate(boxes) for b in boxes[:i]), drawn.name
        assert all(box.x1 <= drawn.figure.bbox.x1 for box in boxes), drawn.name


def test_no_curve_is_cut_by_its_panel(write_study):
    results = run_study(read_study(write_study()))
    (drawn, *_) = (d for d in figures(results) if d.name.startswith("film_and_friction"))
    for panel in drawn.figure.axes[1:]:
        assert max(line.get_ydata().max() for line in panel.lines) < panel.get_ylim()[1]
