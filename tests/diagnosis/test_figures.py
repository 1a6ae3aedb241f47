"""Figures show what the answer says, with units."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import PatchCollection
from matplotlib.figure import Figure

from mixedlub.diagnosis.assessment.identifiability import confusion
from mixedlub.diagnosis.assessment.power_law import Absorbed, DescribedDiscrepancy
from mixedlub.diagnosis.assessment.power_law import describe_discrepancy as describe
from mixedlub.diagnosis.diagnose import Diagnosis
from mixedlub.diagnosis.explanation import DISCREPANCY, NOTHING, Explanation
from mixedlub.diagnosis.report.figures import charts, figures, maps
from mixedlub.diagnosis.report.figures.style import as_drawn, blank, inline, look
from mixedlub.kinds import kind
from mixedlub.schema.table import Table


def labels(figure: Figure) -> str:
    """Every axis label of a figure."""
    return " | ".join(axes.get_xlabel() + " | " + axes.get_ylabel() for axes in figure.axes)


@pytest.fixture(scope="module")
def drawn(offset: Diagnosis) -> dict[str, Figure]:
    """Every figure of the offset rig."""
    return figures.all_figures(offset)


def test_every_figure_of_a_gear_case_is_drawn(drawn: dict[str, Figure]) -> None:
    assert set(drawn) >= {
        "recorded_against_simulated",
        "missing_part",
        "residual_map",
        "profiles",
        "evidence",
        "confusability",
        "heldout",
        "intervals",
    }
    assert "roll_angle_map" not in drawn


def test_nothing_missing_has_no_missing_part(complete: Diagnosis) -> None:
    assert figures.missing_part(complete) is None


def test_roll_angle_map_takes_the_place_of_the_condition_map(teeth: Diagnosis) -> None:
    figure = maps.roll_angle_map(teeth)
    assert figure is not None
    assert "roll angle (°)" in labels(figure)
    assert maps.residual_map(teeth) is None


@pytest.mark.parametrize(
    ("name", "wanted"),
    [
        ("recorded_against_simulated", "simulated power loss (W)"),
        ("missing_part", "missing part of the reading (W)"),
        ("residual_map", "torque (N m)"),
        ("profiles", "oil temperature (°C)"),
        ("heldout", "(sigma)"),
        ("intervals", "recorded − predicted (%)"),
        ("evidence", "probability"),
    ],
)
def test_axes_carry_units(drawn: dict[str, Figure], name: str, wanted: str) -> None:
    assert wanted in labels(drawn[name])


def test_map_has_a_tile_for_every_reading(offset: Diagnosis) -> None:
    with look():
        figure = maps.residual_map(offset)
    assert figure is not None
    tiles = [c for axes in figure.axes for c in axes.collections if isinstance(c, PatchCollection)]
    assert sum(len(c.get_paths()) for c in tiles) == 2 * offset.search.problem.y.size


def test_tiles_carry_the_residuals(offset: Diagnosis) -> None:
    before, after = offset.residuals
    figure = maps.residual_map(offset)
    assert figure is not None
    shown = np.concatenate([c.get_array() for axes in figure.axes for c in axes.collections[:1] if axes.get_title()])
    sound = offset.outlier_chance <= 0.5
    np.testing.assert_allclose(np.sort(shown[np.isfinite(shown)]), np.sort([*before[sound], *after[sound]]))


def test_roll_angle_cells_do_not_overlap(teeth: Diagnosis) -> None:
    figure = maps.roll_angle_map(teeth)
    assert figure is not None
    boxes = [p.get_extents() for p in figure.axes[0].collections[0].get_paths()]
    rows: dict[float, list[tuple[float, float]]] = {}
    for box in boxes:
        rows.setdefault(round(box.y0, 3), []).append((box.x0, box.x1))
    for spans in rows.values():
        ordered = sorted(spans)
        assert all(a[1] <= b[0] + 1e-9 for a, b in pairwise(ordered))


def test_block_of_tiles_fills_its_square() -> None:
    for count in range(1, 14):
        tiles = maps._block(count)
        assert len(tiles) == count
        assert sum(w * h for _, _, w, h in tiles) == pytest.approx(0.92**2)


def test_readings_over_decades_are_compared_by_the_logarithm(thickening: Diagnosis) -> None:
    before, _ = thickening.residuals
    ratio = np.log(thickening.readings / thickening.recorded.calibrated)
    np.testing.assert_allclose(before, ratio / 0.02, rtol=0.01)


@pytest.mark.parametrize("rig", ["offset", "thickening"])
def test_missing_part_is_what_the_answer_adds(rig: str, request: pytest.FixtureRequest) -> None:
    d = request.getfixturevalue(rig)
    observed, explained = d.missing
    np.testing.assert_allclose(d.readings - observed, d.recorded.predicted - explained)
    assert np.sign(explained[np.argmax(np.abs(d.recorded.mismatch_z))]) == np.sign(
        d.recorded.mismatch_z[np.argmax(np.abs(d.recorded.mismatch_z))]
    )


def test_condition_that_only_drifts_has_no_axis(offset: Diagnosis) -> None:
    columns = dict(offset.recorded.table.columns)
    columns["oil_temperature_C"] = 60.0 + 0.01 * np.arange(len(offset.recorded.table))
    drifting = replace(offset, recorded=replace(offset.recorded, table=Table(columns)))
    assert "oil_temperature_C" not in (maps.frame_of(drifting).across, maps.frame_of(drifting).up)
    assert maps.frame_of(drifting).panel == ""


def history(offset: Diagnosis, **more: np.ndarray) -> Diagnosis:
    """The same answer as one to a history of friction whose load only jitters after its start-up."""
    count = len(offset.recorded.table)
    columns = dict(offset.recorded.table.columns) | {
        "time_s": np.arange(float(count)),
        "load_N": np.concatenate([[5.0], 50.0 + 0.01 * np.arange(count - 1)]),
        "slide_roll_ratio": np.tile([0.01, 0.1], count)[:count],
    }
    case = replace(offset.case, kind=kind("friction_history"))
    return replace(offset, case=case, recorded=replace(offset.recorded, table=Table(columns | more)))


def test_a_history_is_drawn_over_time_and_not_over_jitter(offset: Diagnosis) -> None:
    assert maps.frame_of(history(offset)) == maps.Frame("time_s", "slide_roll_ratio", "oil_temperature_C")
    warm = 120.0 + 0.01 * np.arange(len(offset.recorded.table))
    assert maps.frame_of(history(offset, oil_temperature_C=warm)).panel == ""


def test_labels_of_many_levels_do_not_overlap(offset: Diagnosis) -> None:
    count = len(offset.recorded.table)
    columns = dict(offset.recorded.table.columns) | {"speed_rpm": np.geomspace(0.0202, 1.59, 14)[np.arange(count) % 14]}
    figure = maps.residual_map(replace(offset, recorded=replace(offset.recorded, table=Table(columns))))
    assert figure is not None
    FigureCanvasAgg(figure).draw()
    for axes in figure.axes[:-1]:
        boxes = [label.get_window_extent() for label in axes.get_xticklabels() if label.get_visible()]
        assert all(left.x1 <= right.x0 for left, right in pairwise(boxes))


def test_outliers_are_marked(offset: Diagnosis) -> None:
    figure = figures.recorded_against_simulated(offset)
    hollow = figure.axes[0].collections[-1]
    np.testing.assert_allclose(
        np.sort(hollow.get_offsets()[:, 1]), np.sort(offset.search.problem.y[offset.outlier_chance > 0.5])
    )


def test_evidence_shows_the_probabilities(offset: Diagnosis) -> None:
    figure = charts.evidence(offset)
    shown = [line.get_xdata()[-1] for line in figure.axes[0].lines if len(line.get_xdata()) == 2]
    assert shown[0] == pytest.approx(offset.posterior.weights[offset.posterior.verdict])


def test_instrument_and_physics_have_their_own_colours(offset: Diagnosis) -> None:
    every = (NOTHING, DISCREPANCY, Explanation.of("sensor_offset"), Explanation.of("inlet_shear_heating"))
    colours = {charts.colour_of(offset, k) for k in every}
    assert len(colours) == 4


def test_cosines_are_symmetric_with_one_on_the_diagonal(offset: Diagnosis) -> None:
    alike = confusion(offset.search)
    np.testing.assert_allclose(alike.cosine, alike.cosine.T, atol=1e-9)
    np.testing.assert_allclose(np.diag(alike.cosine), 1.0, atol=1e-9)


def test_calibration_takes_its_share_of_every_effect(offset: Diagnosis) -> None:
    alike = confusion(offset.search)
    assert (alike.absorbed >= 0.0).all()
    assert (alike.absorbed <= 1.0).all()


def test_map_of_conditions_puts_speed_across_torque_up(offset: Diagnosis) -> None:
    assert maps.frame_of(offset) == maps.Frame("speed_rpm", "torque_Nm", "oil_temperature_C")


def test_stages_that_absorb_the_unnamed_are_drawn_in_order(unnamed: Diagnosis) -> None:
    figure = charts.absorbing_stages(describe(unnamed.search))
    assert figure is not None
    widths = [bar.get_width() for bar in figure.axes[0].patches]
    assert widths == sorted(widths, reverse=True)


def test_tick_labels_of_the_stages_lie_within_the_figure() -> None:
    names = ("boundary_friction", "area_ratio", "film_thickness", "shear_stress", "power_loss", "load_share")
    for top in np.arange(1.0, 2.0, 0.05):
        stages = (*(Absorbed("film", name, float(top)) for name in names), Absorbed("shear", "shear_rate", -3.0))
        with look():
            figure = charts.absorbing_stages(DescribedDiscrepancy(stages, None))
        assert figure is not None
        as_drawn(figure)
        drawn = figure.axes[0].get_tightbbox()
        assert drawn is not None
        assert drawn.x1 <= figure.get_window_extent().x1, top


def test_quantities_that_could_take_it_up_alike_have_no_bars() -> None:
    alike = (Absorbed("boundary", "boundary_friction", 90.0), Absorbed("boundary", "friction", 89.9))
    assert charts.absorbing_stages(DescribedDiscrepancy(alike, None)) is None
    assert (
        charts.absorbing_stages(DescribedDiscrepancy((*alike, Absorbed("load", "load_share", 4.0)), None)) is not None
    )


def test_labels_have_room_beside_whatever_ticks_are_drawn() -> None:
    for height in np.arange(2.4, 2.8, 0.05):
        with look():
            figure = blank(3.2, float(height))
            axes = figure.add_subplot()
        axes.set_ylim(-8.93, 7.83)
        axes.set_ylabel("mean residual (sigma)")
        as_drawn(figure)
        label = axes.yaxis.label
        assert label.get_position()[0] > label.get_fontsize(), height


def overprinted(figure: Figure) -> list[str]:
    """Labels of an x axis that lie on their neighbours."""
    with look():
        figure.draw_without_rendering()
        boxes = [
            (t.get_window_extent(), t.get_text()) for a in figure.axes for t in a.get_xticklabels() if t.get_text()
        ]
    return [text for (a, _), (b, text) in pairwise(boxes) if a.overlaps(b)]


@pytest.mark.parametrize("largest", [0.0197, 0.9, 1234.5])
def test_labels_of_the_empirical_form_do_not_overprint(teeth: Diagnosis, largest: float) -> None:
    extra = describe(teeth.search)
    assert extra.law is not None
    shape = np.linspace(0.0, largest / abs(extra.law.coefficient), extra.law.shape.size)
    with look():
        figure = charts.empirical_form(teeth, replace(extra, law=replace(extra.law, shape=shape)))
    assert figure is not None
    assert not overprinted(figure)


def test_noise_about_like_simulations_is_that_of_the_usual_reading() -> None:
    sd = np.array([0.5, 3.0, 1.0, 0.1, 9.0])
    line = np.linspace(0.0, 4.0, 9)
    np.testing.assert_allclose(figures._noise_along(line, np.full(5, 2.0), sd, False), 1.0)


@pytest.mark.parametrize("logarithmic", [False, True])
def test_noise_in_proportion_widens_along_the_line(logarithmic: bool) -> None:
    simulated = np.geomspace(1.0, 7.0, 101)
    line = np.linspace(1.3, 5.5, 9)
    np.testing.assert_allclose(
        figures._noise_along(line, simulated, 0.1 * simulated, logarithmic), 0.1 * line, rtol=0.02
    )


def test_names_of_levels_differ_where_levels_do() -> None:
    values = np.array([20.48, 25.04, 24.96, 25.06, 29.96, 49.98, 50.02, 50.06, 75.0, 20.5, 99.96])
    label, names = maps._ticks(values)
    assert len(set(names)) == len(names) == label.max() + 1
    assert label[1] == label[2]
    many = np.concatenate([values, np.linspace(20.0, 100.0, 200)])
    for texts in (maps._ticks(many)[1], maps._levels(many, 4, "temperature_C")[1]):
        assert len(set(texts)) == len(texts)


def test_form_is_drawn_only_where_a_law_holds(unnamed: Diagnosis, teeth: Diagnosis) -> None:
    assert charts.empirical_form(unnamed, replace(describe(unnamed.search), law=None)) is None
    assert charts.empirical_form(teeth, describe(teeth.search)) is not None


def test_equal_figures_are_equal_text(offset: Diagnosis) -> None:
    first, second = (as_drawn(charts.evidence(offset)) for _ in range(2))
    assert first == second
    assert "<dc:date>" not in first


def test_ids_are_prefixed_where_defined_and_where_used() -> None:
    svg = '<svg><g id="a"/><use xlink:href="#a"/><path clip-path="url(#a)"/></svg>'
    assert inline(svg, "x") == '<svg><g id="x-a"/><use xlink:href="#x-a"/><path clip-path="url(#x-a)"/></svg>'


@pytest.mark.parametrize("name", ["evidence", "confusability", "intervals", "heldout"])
def test_nothing_of_a_figure_is_cut_at_its_edge(offset: Diagnosis, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Long names of explanations pushed the label of the axis beyond the right edge."""
    monkeypatch.setattr(
        charts, "explanation_words", lambda names: "boundary speed dependence and limiting shear stress"
    )
    figure = figures.all_figures(offset)[name]
    as_drawn(figure)
    inside, frame = figure.get_tightbbox(), figure.bbox_inches
    assert inside.x0 >= 0.0
    assert inside.y0 >= 0.0
    assert inside.x1 <= frame.x1
    assert inside.y1 <= frame.y1


def test_intervals_keep_outliers_within_the_axes_and_count_them(offset: Diagnosis) -> None:
    count = len(offset.outlier_runs)
    assert count
    with look():
        axes = figures.intervals(offset).axes[0]
    low, high = axes.get_ylim()
    places = np.vstack([c.get_offsets() for c in axes.collections if 26.0 in c.get_sizes()])
    assert len(places) == count
    assert np.all((places[:, 1] > 0.95 * low) & (places[:, 1] < 0.95 * high))
    assert f"{count} outlier" in axes.get_title(loc="left")
    ticks = axes.get_xticks()
    assert np.array_equal(ticks, np.round(ticks))
