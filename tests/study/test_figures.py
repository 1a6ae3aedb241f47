"""Figures stay readable whatever the size of the study."""

import numpy as np
import pytest

from mixedlub.report.figures import MOST_PANELS, equal_pairings, figures
from mixedlub.report.paper_figures import SHAPES, paper_figures
from mixedlub.report.plots import MOST_LEVELS, MOST_PAIRINGS, OUTSIDE
from mixedlub.study import read_study, run_study
from tests.study.conftest import BASE, study_file


@pytest.fixture(scope="module")
def many(tmp_path_factory):
    from tests.study.conftest import toml

    surfaces = {f"s{i}": {"m0_um2": 0.01 + 0.006 * i, "m2": 0.0025, "m4_per_um2": 0.0036} for i in range(26)}
    levels = {"from": 10, "to": 200, "count": 9}
    conditions = {"torque_Nm": levels, "speed_rpm": levels, "oil_temperature_C": [40, 60, 80]}
    path = tmp_path_factory.mktemp("many") / "many.toml"
    data = {**BASE, "surfaces": surfaces, "conditions": conditions}
    path.write_text("\n".join(f"{key} = {toml(value)}" for key, value in data.items()))
    return run_study(read_study(path))


@pytest.fixture(scope="module")
def many_drawn(many):
    return {d.name: d for d in figures(many)}


@pytest.fixture(scope="module")
def usual(tmp_path_factory):
    return run_study(read_study(study_file(tmp_path_factory.mktemp("usual"))))


@pytest.fixture(scope="module")
def usual_drawn(usual):
    return {d.name: d for d in figures(usual)}


def test_many_levels_are_thinned_and_said(many_drawn):
    drawn = many_drawn
    assert {name.rpartition("_")[2] for name in drawn} == {"40C", "80C", "temperature"}
    panels = [a for a in drawn["power_loss_equal_40C"].figure.axes if a.lines]
    assert len(panels) == MOST_PANELS
    assert all(len(a.lines) == MOST_LEVELS for a in panels)
    assert f"{MOST_PAIRINGS} of 351 pairings" in drawn["loss_over_roughness_40C"].caption


def test_captions_say_which_levels_are_drawn(many_drawn, usual_drawn):
    drawn = {name: d.caption for name, d in many_drawn.items()}
    torques, speeds = "Drawn are 6 of 9 torques: 10, ", "Drawn are 6 of 9 speeds: 10, "
    for name in ("loss_over_roughness", "loss_over_film_parameter", "loss_over_area_ratio"):
        assert "Drawn are 3 of 9 torques: 10, 105 and 200 N m." in drawn[f"{name}_40C"]
        assert speeds in drawn[f"{name}_40C"]
    assert "fitted at each torque and speed drawn" in drawn["loss_over_roughness_40C"]
    for name in ("power_loss_equal", "film_and_friction"):
        assert torques in drawn[f"{name}_40C"]
        assert "speeds:" not in drawn[f"{name}_40C"]
    assert not any("Drawn" in d.caption for d in usual_drawn.values())


def test_axes_carry_quantity_and_unit(many_drawn):
    for drawn in many_drawn.values():
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
            assert [text.get_text() for text in legend.get_texts()] == ["50 N m", "150 N m", OUTSIDE]


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


def test_no_curve_is_cut_by_its_panel(usual_drawn):
    for drawn in usual_drawn.values():
        for panel in (a for a in drawn.figure.axes if a.lines and a.get_yscale() == "linear"):
            highest = max((np.max(line.get_ydata()) for line in panel.lines if len(line.get_ydata())), default=0.0)
            assert highest <= panel.get_ylim()[1], drawn.name


def test_middle_temperatures_are_drawn_and_captions_say_which_are_left_out(many_drawn):
    drawn = many_drawn
    over = drawn["power_loss_equal_temperature"]
    assert all(list(line.get_xdata()) == [40, 60, 80] for a in over.figure.axes for line in a.lines)
    for name, figure in drawn.items():
        if name != over.name:
            assert "Drawn are 2 of 3 oil temperatures: 40 and 80 °C." in figure.caption, name


def test_two_temperatures_need_no_figure_over_temperature(usual_drawn):
    assert not any("temperature" in d.name or "oil temperatures:" in d.caption for d in usual_drawn.values())


@pytest.fixture(scope="module")
def odd(tmp_path_factory):
    """Six speeds that are no whole numbers, torques from small to large, surfaces from smooth to rough."""
    from tests.study.conftest import toml

    surfaces = {f"surface{i}": {"m0_um2": 0.001 * 8**i, "m2": 0.0015, "m4_per_um2": 0.0036} for i in range(5)}
    conditions = {
        "torque_Nm": {"from": 10, "to": 300, "count": 80},
        "speed_rpm": [0.96071, 0.987142, 961.25, 133.3333, 2987.12, 1500.5],
        "oil_temperature_C": [60],
    }
    path = tmp_path_factory.mktemp("odd") / "odd.toml"
    data = {**BASE, "surfaces": surfaces, "conditions": conditions}
    path.write_text("\n".join(f"{key} = {toml(value)}" for key, value in data.items()))
    return {d.name: d for d in figures(run_study(read_study(path)))}


def test_legends_stand_within_the_figure_and_off_the_panels(odd):
    for name, drawn in odd.items():
        drawn.figure.draw_without_rendering()
        (legend,) = drawn.figure.legends
        box = legend.get_window_extent()
        assert box.x0 >= 0, name
        assert box.x1 <= drawn.figure.bbox.x1, name
        assert box.y1 <= drawn.figure.bbox.y1, name
        assert not any(box.overlaps(a.get_window_extent()) for a in drawn.figure.axes if a.get_visible()), name


def test_levels_are_told_in_four_digits(odd):
    for name in ("power_loss_equal", "loss_over_film_parameter"):
        for text in odd[name].figure.legends[0].get_texts():
            if text.get_text() != OUTSIDE:
                assert len(text.get_text().split()[0].replace(".", "").lstrip("0")) <= 4
    labels = [t.get_text() for t in odd["loss_over_film_parameter"].figure.legends[0].get_texts()]
    assert labels == ["2987 rpm", "1500 rpm", "961.2 rpm", "133.3 rpm", "0.9871 rpm", "0.9607 rpm", OUTSIDE]


def test_labels_of_neighbouring_panels_do_not_touch(odd):
    for name, drawn in odd.items():
        drawn.figure.draw_without_rendering()
        labels = [a.xaxis.label.get_window_extent() for a in drawn.figure.axes if a.get_xlabel() and a.get_visible()]
        assert not any(a.overlaps(b) for i, a in enumerate(labels) for b in labels[:i]), name


def test_panels_of_an_incomplete_row_are_as_large_as_the_others(odd):
    figure = odd["power_loss_equal"].figure
    figure.draw_without_rendering()
    panels = [a for a in figure.axes if a.get_visible() and a.lines]
    assert len(panels) == 5
    assert np.ptp([a.get_position().height for a in panels]) < 1e-6
    assert np.ptp([a.get_position().width for a in panels]) < 1e-6
    assert all(a.get_xlabel() for a in panels)


def test_loss_over_film_parameter_has_points_and_no_line_between_pairings(odd):
    for panel in odd["loss_over_film_parameter"].figure.axes:
        lines = [line for line in panel.lines if line.get_linestyle() != "None" and len(set(line.get_xdata())) > 1]
        assert lines == []


def test_a_small_torque_has_a_panel_that_is_not_empty(odd):
    drawn = odd["loss_over_roughness"]
    assert "its own scale" in drawn.caption
    for panel in drawn.figure.axes:
        highest = max(line.get_ydata().max() for line in panel.lines if len(line.get_ydata()))
        assert highest > 0.5 * panel.get_ylim()[1]


def test_ratios_near_zero_are_on_a_logarithmic_axis(odd):
    drawn = odd["area_ratio_equal"]
    assert {a.get_yscale() for a in drawn.figure.axes if a.lines} == {"log"}
    assert "logarithmic" in drawn.caption


def test_hollow_marks_are_outside_the_range_in_every_figure_and_the_legend_says_so(write_study):
    """A shape tells a torque where one panel has several, and nothing else in any figure."""
    surfaces = {**BASE["surfaces"], "smooth": {"m0_um2": 4e-4, "m2": 2e-4, "m4_per_um2": 4e-4}}
    results = run_study(read_study(write_study(surfaces=surfaces, conditions__oil_temperature_C=[60])))
    assert 0 < results.outside.sum() < results.outside.size
    for drawn in (*figures(results), *paper_figures(results)):
        (legend,) = drawn.figure.legends
        told = {text.get_text(): handle for text, handle in zip(legend.get_texts(), legend.legend_handles)}
        assert told["outside the model's range"].get_markerfacecolor() == "white", drawn.name
        lines = [line for panel in drawn.figure.axes for line in panel.lines if line.get_marker() != "None"]
        shapes = {line.get_marker() for line in lines if len(line.get_xdata())}
        alone = drawn.name in ("paper_09_loss_over_film_parameter", "paper_10_loss_over_area_ratio")
        assert shapes == (set(SHAPES[:2]) if alone else {"o"}), drawn.name
        if alone:
            assert {told["50 N m"].get_marker(), told["150 N m"].get_marker()} == shapes
    panels = {d.name: d for d in figures(results)}["loss_over_roughness"].figure.axes
    faces = [(line.get_markerfacecolor(), len(line.get_xdata())) for a in panels for line in a.lines]
    assert sum(count for face, count in faces if isinstance(face, str) and face == "white") == results.outside.sum()


def test_the_outermost_pairings_are_among_those_drawn(many, many_drawn):
    panel = many_drawn["loss_over_area_ratio_40C"].figure.axes[0]
    drawn = np.concatenate([line.get_xdata() for line in panel.lines if line.get_linestyle() == "None"])
    ratio = many["area_ratio"][:, 0, 0]
    assert drawn.max() == ratio.max()
    assert drawn.min() == ratio.min()


def test_an_unknown_format_is_bad_input(write_study, tmp_path, capsys):
    from mixedlub.cli import main

    assert main(["study", str(write_study()), "--out", str(tmp_path / "o"), "--format", "jpeg"]) == 2
    assert "--format" in capsys.readouterr().err


def test_traces_of_very_different_height_have_their_own_scales_and_it_is_said(write_study, tmp_path):
    from mixedlub.report.surfaces import judgement, surface_figures, traced

    x = np.arange(8000) * 0.5
    z = np.convolve(np.random.default_rng(1).normal(size=x.size), np.ones(20) / 20, "same") * 5.0
    np.savetxt(tmp_path / "rough.csv", np.column_stack([x, z]), delimiter=",", header="x (um),z (um)", comments="")
    surfaces = {"rough_in": {"profile": "rough.csv"}, "polished": {"profile": "shipped:0036"}}
    study = read_study(write_study(surfaces=surfaces))
    profiles = traced(study)
    traces, probability = surface_figures(study, profiles, judgement(profiles))
    assert "own scale" in traces.caption
    assert all(
        max(abs(a.collections[0].get_paths()[0].vertices[:, 1])) > 0.3 * a.get_ylim()[1] for a in traces.figure.axes
    )
    assert {t.get_text() for t in probability.figure.legends[0].get_texts()} >= {"heights", "Gaussian"}


def test_a_doubtful_verdict_is_doubted_at_its_panel(write_study):
    from mixedlub.report.surfaces import judgement, surface_figures, traced

    study = read_study(write_study(surfaces={"few": {"profile": "shipped:0122"}}))
    profiles = traced(study)
    _, probability = surface_figures(study, profiles, judgement(profiles))
    title = probability.figure.axes[0].get_title(loc="left")
    assert "19 independent heights" in title
    assert "0.14 × Gaussian" in title


def test_conditions_outside_the_range_are_hollow(usual, usual_drawn):
    """As many hollow marks as there are such conditions among those drawn."""
    results = usual
    drawn = next(d for name, d in usual_drawn.items() if name.startswith("power_loss_equal"))
    chosen = equal_pairings(results)
    hollow = sum(len(c.get_offsets()) for panel in drawn.figure.axes for c in panel.collections)
    assert hollow == results.outside[chosen, 0].sum()
    assert "Hollow" in drawn.caption
