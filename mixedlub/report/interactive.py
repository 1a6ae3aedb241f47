"""Interactive chart on the page of a study: drawn by Vega-Lite in the browser, described here with Vega-Altair.

The page contains the rows and the library, so that nothing is fetched. Choices of the reader are parameters of the
specification; the library makes the lists, redraws, and saves the chart as a picture.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any

from mixedlub.report.chart_rows import SIDES, ChartRows, chart_rows
from mixedlub.report.plots import shown
from mixedlub.report.style import FONTS, in_words, labelled
from mixedlub.schema.units import unit_of, without_unit
from mixedlub.study.bands import HIGH, LOW
from mixedlub.study.columns import VALID, VALIDITY
from mixedlub.study.results import Results
from mixedlub.study.validity import out_of_range

if TYPE_CHECKING:
    import altair as alt

PLACE = "chart"
"""Identifier of the page element of the chart."""
EMBEDDING: Mapping[str, Any] = {
    "mode": "vega-lite",
    "renderer": "svg",
    "actions": {"export": True, "source": False, "compiled": False, "editor": False},
    "defaultStyle": False,
    "logLevel": 1,
    "scaleFactor": {"svg": 1, "png": 3},
}
"""Settings of the library: a scaling drawing, links to save it, and no links to other sites."""
CONDITIONS = ("speed_rpm", "torque_Nm", "oil_temperature_C")
ABSCISSAS = ("composite_roughness_um", "film_parameter", "boundary_area_ratio")
"""Columns that can be the abscissa instead of a condition, as in figures 8 to 10 of Hong, Aneshansley and Talbot."""
FIRST = ("power_loss_W", "mean_friction", "film_parameter", "minimum_film_parameter", "boundary_area_ratio")
"""Quantities at the head of their list."""
LEAST_AT_FIRST = ("oil_temperature_C",)
"""Conditions initially at their lowest level; all others are initially at the highest."""
PAIRING, ALL = "pairing", "all"
HEIGHT = 380
MOST_NAMED = 80
"""Largest number of names in the legend; the lists of surfaces offer more."""
WIDEST_NAME, LETTER, BESIDE_NAME, COLUMN_GAP = 240, 6.8, 20, 14
"""Width of the longest name in the legend, of a letter in it, of the mark beside it, and between columns (pixels)."""
FAINT = 0.08
"""Opacity of unselected pairings."""
GREY, INK = "#5b6770", "#1d2329"


@dataclass(frozen=True, eq=False)
class Explorer:
    """Specification and rows of the chart, text of the library (empty without it), and meaning of the flags."""

    specification: Mapping[str, Any]
    rows: ChartRows
    library: str
    flags: Sequence[tuple[str, str]]


def explorer(results: Results) -> Explorer:
    """Interactive chart of a study with its rows; without the optional library, the rows alone."""
    rows = chart_rows(results)
    flags = [(code, one.text) for code, one in zip(results.flags, out_of_range(results), strict=False)]
    try:
        return Explorer(specification(results, rows), rows, library(), flags)
    except ModuleNotFoundError:
        return Explorer({}, rows, "", flags)


@cache
def library() -> str:
    """Text of Vega-Lite; bundled once per process, as that takes seconds."""
    import altair as alt
    import vl_convert

    version = ".".join(alt.SCHEMA_VERSION.split(".")[:2])
    return str(vl_convert.javascript_bundle(vl_version=version))  # type: ignore[call-arg]


def specification(results: Results, rows: ChartRows) -> dict[str, Any]:
    """The chart as a Vega-Lite specification."""
    import altair as alt

    one = _Chart.of(results, rows)
    chart = one.chosen(alt.layer(*one.layers(), data=one.data())).add_params(*one.parameters())
    title = alt.TitleParams(text=alt.ExprRef("labels[quantity]"), anchor="start", fontSize=12, fontWeight="normal")
    fitted = alt.AutoSizeParams(type="fit-x", contains="padding", resize=True)
    chart = chart.properties(name="study", width="container", height=HEIGHT, title=title, autosize=fitted)
    chart = chart.properties(description=f"Results of {results.study.file.title}, chosen from the lists above")
    chart = chart.configure_view(stroke=None).configure(font=FONTS.replace("'", ""))
    chart = chart.configure_legend(labelFontSize=11, rowPadding=5, columnPadding=COLUMN_GAP)
    return chart.configure_axis(gridColor="#e5e5e5", format="~r", labelFlush=False, labelFontSize=11).to_dict()


@dataclass(frozen=True, eq=False)
class _Chart:
    """Names of the columns offered in the chart, and its parts."""

    rows: ChartRows
    labels: Mapping[str, str]
    varied: Sequence[str]
    quantities: Sequence[str]
    surfaces: Sequence[str]
    bands: Mapping[str, tuple[str, str]]

    @classmethod
    def of(cls, results: Results, rows: ChartRows) -> _Chart:
        whose = results.study.file.options.conditions_of
        names = {c.output: c.name for c in results.columns}
        single = [name for output, name in names.items() if not output.startswith((LOW, HIGH))]
        bands = {
            name: (names[LOW + output], names[HIGH + output])
            for output, name in names.items()
            if LOW + output in names and HIGH + output in names
        }
        of_wheel = {name: f"{whose} {labelled(name)}" for name in ("speed_rpm", "torque_Nm")}
        return cls(
            rows=rows,
            labels={name: labelled(name) for name in (*CONDITIONS, *single)} | of_wheel,
            varied=[name for name in CONDITIONS if rows.table[name].nunique() > 1],
            quantities=sorted(single, key=lambda name: FIRST.index(name) if name in FIRST else len(FIRST)),
            surfaces=list(dict.fromkeys(name for side in SIDES for name in rows.table[side])),
            bands=bands,
        )

    def parameters(self) -> Iterator[alt.Parameter]:
        """Parameters with lists of choices, and names used in expressions."""
        import altair as alt

        yield _choice("quantity", "quantity", {name: self.labels[name] for name in self.quantities})
        yield _choice("abscissa", "over", {name: self.labels[name] for name in self.abscissas})
        yield _choice("colour_by", "a colour for each", {name: in_words(name) for name in (PAIRING, *self.varied)})
        for name in self.varied:
            levels = sorted(self.rows.table[name].unique().tolist())
            first = levels[0 if name in LEAST_AT_FIRST else -1]
            texts: dict[Any, str] = dict(zip(levels, shown(levels), strict=True))
            yield _choice(_held(name), self.labels[name], texts | {None: ALL}, first)
        if len(self.surfaces) > 1:
            of_pairing: dict[Any, str] = {None: ALL, **{name: name for name in self.surfaces}}
            yield _choice("one_surface", "one surface", of_pairing)
            yield _choice("other_surface", "the other surface", of_pairing)
        yield alt.param(name="labels", value=self.labels)
        yield alt.param(name="units", value={name: unit_of(name) for name in CONDITIONS})
        for end, place in (("low", 0), ("high", 1)):
            yield alt.param(name=end, value={name: ends[place] for name, ends in self.bands.items()})

    @property
    def abscissas(self) -> list[str]:
        return [*self.varied, *(name for name in ABSCISSAS if name in self.quantities)]

    def data(self) -> alt.Data:
        """The rows of all layers."""
        import altair as alt

        words = (*SIDES, VALIDITY)
        kinds = {name: "string" if name in words else "number" for name in self.rows.table.columns}
        return alt.Data(values=self.rows.text, format=alt.CsvDataFormat(type="csv", parse=kinds))

    def chosen(self, chart: alt.LayerChart | alt.FacetChart) -> alt.LayerChart | alt.FacetChart:
        """The rows at the chosen conditions and surfaces, with the chosen quantity, abscissa and colour."""
        for name in self.varied:
            at = _held(name)
            chart = chart.transform_filter(f"abscissa == '{name}' || {at} == null || datum.{name} == {at}")
        if len(self.surfaces) > 1:
            chart = chart.transform_filter(_of_both())
        others = "".join(f" + (abscissa == '{name}' ? '' : '|' + datum.{name})" for name in self.varied)
        level = "format(datum[colour_by], '.6~r') + ' ' + units[colour_by]"
        chart = chart.transform_calculate(
            x="datum[abscissa]",
            y="datum[quantity]",
            low="datum[low[quantity]]",
            high="datum[high[quantity]]",
            pairing="datum.pinion_surface + ' / ' + datum.gear_surface",
        )
        return chart.transform_calculate(
            series=f"datum.pairing{others}",
            colour=f"colour_by == '{PAIRING}' ? datum.pairing : {level}",
            rank=f"colour_by == '{PAIRING}' ? datum.composite_roughness_um : datum[colour_by]",
        )

    def layers(self) -> Iterator[alt.Chart]:
        """Bands, lines, marks within and outside the range of the model, pointer selection, and texts."""
        import altair as alt

        picked = alt.selection_point(
            name="picked",
            fields=["colour"],
            bind="legend",
            toggle="true",
            on="click[false]",  # names of the legend alone are clicked
            clear="dblclick, window:change[event.target.name === 'colour_by']",
        )
        found = alt.selection_point(
            name="found", nearest=True, on="pointerover", clear="pointerout", encodings=["x", "y"]
        )
        colour = alt.Color(
            "colour:N",
            sort=alt.EncodingSortField(field="rank", op="min", order="ascending"),
            scale=alt.Scale(scheme=alt.SchemeParams(name="viridis", extent=[0.95, 0.1])),
            legend=alt.Legend(
                title=None,
                orient="bottom",
                offset=32,
                columns=alt.ExprRef(f"max(1, floor(width / {self._name_width() + BESIDE_NAME + COLUMN_GAP}))"),
                symbolLimit=MOST_NAMED,
                symbolType="circle",
                labelLimit=WIDEST_NAME,
            ),
        )
        drawn = alt.Chart().encode(
            x=alt.X("x:Q", scale=alt.Scale(zero=False), axis=_axis("width", 130)),
            y=alt.Y("y:Q", axis=_axis("height", 50)),
            color=colour,
            detail="series:N",
            opacity=alt.when(picked).then(alt.value(1.0)).otherwise(alt.value(FAINT)),
        )
        joined = f"indexof({json.dumps(list(self.varied))}, abscissa) >= 0"
        yield drawn.transform_filter(joined).mark_line(strokeWidth=1.6).properties(name="lines").add_params(picked)
        if self.bands:
            shaded = drawn.transform_filter("isValid(datum.low)").encode(
                y="low:Q", y2="high:Q", opacity=alt.when(picked).then(alt.value(0.18)).otherwise(alt.value(0.0))
            )
            yield shaded.transform_filter(joined).mark_area().properties(name="bands")
            yield shaded.transform_filter(f"!({joined})").mark_rule(strokeWidth=4).properties(name="bars")
        within = f"datum.{VALIDITY} == '{VALID}'"
        yield drawn.transform_filter(within).mark_point(filled=True, size=45).properties(name="within")
        hollow = drawn.transform_filter(f"!({within})").properties(name="outside")
        yield hollow.mark_point(filled=False, fill="white", size=40, strokeWidth=1.4)
        ring = drawn.transform_filter({"param": "found", "empty": False}).properties(name="ring")
        yield ring.mark_point(filled=False, size=160, strokeWidth=2)
        numbers = alt.value(alt.ExprRef(self._numbers()))
        target = drawn.transform_filter(picked).encode(opacity=alt.value(0.0), tooltip=numbers)
        yield target.mark_point(filled=True, size=90).properties(name="target").add_params(found)
        yield _text("labels[abscissa]", INK, "height + 22", "top").properties(name="abscissa_title")
        yield _text(self._conditions(), GREY, "-8", "bottom").properties(name="conditions_title")

    def _name_width(self) -> float:
        """Width of the longest name of a pairing in the legend (pixels)."""
        first, second = (self.rows.table[side].str.len() for side in SIDES)
        return min(LETTER * int((first + second + len(" / ")).max()), WIDEST_NAME)

    def _numbers(self) -> str:
        """Tooltip of the nearest mark: all numbers of its row, and the reason for being out of range."""
        row = "(datum.datum || datum)"  # the cell around a mark has the row of the mark in its own
        shown = {"title": f"{row}.pairing"}
        if self.bands:
            ends = " + ' to ' + ".join(f"{row}[{end}[quantity]]" for end in ("low", "high"))
            shown["band of the quantity drawn"] = f"isValid(low[quantity]) ? {ends} : 'none'"
        shown |= {self.labels[name]: f"{row}.{name}" for name in (*CONDITIONS, *self.quantities)}
        shown[VALIDITY] = f"{row}.{VALIDITY}"
        return "{" + ", ".join(f"{json.dumps(name)}: {value}" for name, value in shown.items()) + "}"

    def _conditions(self) -> str:
        """Conditions of all marks, as a text expression."""
        parts = []
        for name in CONDITIONS:
            unit = unit_of(name)
            if name in self.varied:
                at = _held(name)
                held = f"'{in_words(name)} ' + format({at}, '.6~r') + ' {unit}, '"
                parts.append(f"(abscissa == '{name}' || {at} == null ? '' : {held})")
            else:
                (level,) = shown([self.rows.table[name].iloc[0]])
                parts.append(f"'{in_words(name)} {level} {unit}, '")
        return f"replace({' + '.join(parts)}, /, $/, '')"


def _axis(length: str, apart: int) -> alt.Axis:
    """An axis with ticks about ``apart`` pixels apart, at any size of the window."""
    import altair as alt

    return alt.Axis(title=None, tickCount=alt.ExprRef(f"max(2, {length} / {apart})"))


def _held(condition: str) -> str:
    """Parameter with the fixed level of a condition.

    >>> _held("torque_Nm")
    'at_torque'
    """
    return f"at_{without_unit(condition)}"


def _choice(name: str, words: str, texts: Mapping[Any, str], first: Any = None) -> alt.Parameter:
    """A parameter chosen from a list of values with their texts; initially the first."""
    import altair as alt

    values = list(texts)
    listed = alt.binding_select(options=values, labels=list(texts.values()), name=words)
    value = values[0] if first is None else first
    return alt.param(name=name, value=value, bind=listed) if len(values) > 1 else alt.param(name=name, value=value)


def _of_both() -> str:
    """Expression: whether a row has the chosen surfaces, on either wheel; a missing choice matches any surface."""
    ways = (SIDES, SIDES[::-1])
    return " || ".join(
        " && ".join(
            f"({name} == null || datum.{side} == {name})"
            for name, side in zip(("one_surface", "other_surface"), sides, strict=True)
        )
        for sides in ways
    )


def _text(expression: str, colour: str, height: str, baseline: Any) -> alt.Chart:
    """A text at the right end of the chart; titles of axes are fixed in Vega-Lite."""
    import altair as alt

    mark = {"align": "right", "baseline": baseline, "fontSize": 12, "color": colour, "text": alt.ExprRef(expression)}
    ends = {"x": alt.value(alt.ExprRef("width")), "y": alt.value(alt.ExprRef(height))}
    return alt.Chart(alt.Data(values=[{}])).mark_text(**mark).encode(**ends)
