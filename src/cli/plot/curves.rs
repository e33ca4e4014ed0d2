//! The panel of curves: value over wavelength, with the colours of the spectrum below a lone one.

use super::scale::{Scale, Ticks};
use super::svg::{Anchor, Canvas, path_data};
use super::{CURVES_X, Curve, PANEL_Y, Plot, paint, shortened};
use crate::color::Observer;
use crate::spectrum::PiecewiseLinear;

/// Wavelengths shown, nm.
const RANGE_NM: [f64; 2] = [380.0, 780.0];
/// More knots than this are drawn as the smallest and largest value of each of half as many columns.
const MAX_POINTS: usize = 2000;
/// About how many labels there are on the axis of values.
const VALUE_TICKS: f64 = 5.0;

/// Draws the panel.
pub fn draw(plot: &Plot, canvas: &mut Canvas) {
    let tables: Vec<PiecewiseLinear> =
        plot.curves.iter().map(|curve| curve.table.restricted(RANGE_NM[0], RANGE_NM[1])).collect();
    let ticks = value_ticks(&tables, plot.values_are_shares);
    let x = Scale::new(RANGE_NM, CURVES_X);
    let y = Scale::new(ticks.range(), [PANEL_Y[1], PANEL_Y[0]]);
    axes(plot, canvas, &x, &y, &ticks);
    let is_alone = plot.curves.len() == 1;
    if is_alone {
        rainbow(canvas, plot.observer, &outline(&tables[0], &x, &y), y.at(ticks.range()[0].max(0.0)));
    }
    if let Some((name, lamp)) = &plot.lamp {
        draw_lamp(canvas, name, lamp, &x, &y);
    }
    for (i, (curve, table)) in plot.curves.iter().zip(&tables).enumerate() {
        let line = match (is_alone, plot.are_named()) {
            (true, _) => None,
            (_, true) => Some(paint::LINES[i]),
            _ => Some(curve.color),
        };
        draw_curve(canvas, curve, table, line, &x, &y);
    }
    if !is_alone && plot.are_named() {
        legend(plot, canvas);
    }
}

fn value_ticks(tables: &[PiecewiseLinear], are_shares: bool) -> Ticks {
    let lowest = tables.iter().map(PiecewiseLinear::min).fold(0.0, f64::min);
    let highest = tables.iter().map(PiecewiseLinear::max).fold(if are_shares { 1.0 } else { 0.0 }, f64::max);
    match highest > lowest {
        true => Ticks::enclosing(lowest, highest, VALUE_TICKS),
        false => Ticks::enclosing(0.0, 1.0, VALUE_TICKS),
    }
}

fn axes(plot: &Plot, canvas: &mut Canvas, x: &Scale, y: &Scale, ticks: &Ticks) {
    for (&value, label) in ticks.values.iter().zip(&ticks.labels) {
        let at = y.at(value);
        canvas.line(if value == 0.0 { "axis" } else { "grid" }, [CURVES_X[0], at], [CURVES_X[1], at]);
        canvas.text("small", [CURVES_X[0] - 8.0, at + 3.5], Anchor::End, label);
    }
    for nm in (400..=750).step_by(50) {
        let at = x.at(f64::from(nm));
        canvas.line("grid", [at, PANEL_Y[0]], [at, PANEL_Y[1]]);
        canvas.text("small", [at, PANEL_Y[1] + 16.0], Anchor::Middle, &nm.to_string());
    }
    canvas.line("axis", [CURVES_X[0], PANEL_Y[1]], [CURVES_X[1], PANEL_Y[1]]);
    let middle = 0.5 * (CURVES_X[0] + CURVES_X[1]);
    canvas.text("note", [middle, PANEL_Y[1] + 36.0], Anchor::Middle, "wavelength (nm)");
    let [left, middle] = [CURVES_X[0] - 50.0, 0.5 * (PANEL_Y[0] + PANEL_Y[1])];
    canvas.raw(&format!(r#"<g transform="translate({left} {middle}) rotate(-90)">"#));
    canvas.text("note", [0.0, 0.0], Anchor::Middle, plot.value_label);
    canvas.raw("</g>");
}

/// The lamp, scaled to end a little below the top: its own unit is not the axis's.
fn draw_lamp(canvas: &mut Canvas, name: &str, lamp: &PiecewiseLinear, x: &Scale, y: &Scale) {
    let table = lamp.restricted(RANGE_NM[0], RANGE_NM[1]);
    let highest = table.max();
    if highest > 0.0 {
        let top = (y.at(0.0) - PANEL_Y[0]) * 0.97;
        let scale = Scale::new([0.0, highest], [y.at(0.0), y.at(0.0) - top]);
        canvas.path("lamp", &outline(&table, x, &scale), false, "");
        canvas.text(
            "small",
            [CURVES_X[1], PANEL_Y[0] - 6.0],
            Anchor::End,
            &format!("dashed: {} (relative)", shortened(name, 40)),
        );
    }
}

/// The area below a curve, filled with the colours of the wavelengths; they fade out where the eye does.
fn rainbow(canvas: &mut Canvas, observer: &Observer, outline: &[[f64; 2]], base: f64) {
    canvas.raw(&format!(
        r#"<linearGradient id="rainbow" gradientUnits="userSpaceOnUse" x1="{}" y1="0" x2="{}" y2="0">"#,
        CURVES_X[0], CURVES_X[1]
    ));
    let response = |nm: f64| observer.eval(nm).element_sum();
    let largest = (380..=780).map(|nm| response(f64::from(nm))).fold(0.0, f64::max);
    for i in 0..=100 {
        let offset = f64::from(i) / 100.0;
        let nm = RANGE_NM[0] + offset * (RANGE_NM[1] - RANGE_NM[0]);
        // The square root makes the ends visible, as the eye does.
        let response = (response(nm) / largest).sqrt();
        let color = paint::hex(paint::brightest(observer.eval(nm), (1.6 * response).clamp(0.12, 1.0)));
        let opacity = (4.0 * response).clamp(0.3, 1.0);
        canvas.raw(&format!(r#"<stop offset="{offset:.4}" stop-color="{color}" stop-opacity="{opacity:.3}"/>"#));
    }
    canvas.raw("</linearGradient>");
    let mut area = outline.to_vec();
    area.extend([[CURVES_X[1], base], [CURVES_X[0], base]]);
    canvas.raw(&format!(r#"<path d="{}" fill="url(#rainbow)" fill-opacity=".9"/>"#, path_data(&area, true)));
}

fn draw_curve(
    canvas: &mut Canvas,
    curve: &Curve,
    table: &PiecewiseLinear,
    line: Option<[u8; 3]>,
    x: &Scale,
    y: &Scale,
) {
    let stroke = line.map_or(String::new(), |color| format!(r#" style="stroke:{}""#, paint::hex(color)));
    let knots = curve.table.lambdas_nm();
    let [first, last] = [knots[0], knots[knots.len() - 1]].map(|nm| nm.clamp(RANGE_NM[0], RANGE_NM[1]));
    let measured = if first < last { table.restricted(first, last) } else { table.clone() };
    let points = outline(&measured, x, y);
    if line == Some(curve.color) {
        canvas.path("casing", &points, false, "");
    }
    canvas.path("curve", &points, false, &stroke);
    // What is held beyond the samples.
    for [from, to] in [[RANGE_NM[0], first], [last, RANGE_NM[1]]] {
        if from < to {
            let at = |nm: f64| [x.at(nm), y.at(table.eval(nm))];
            canvas.path("curve held", &[at(from), at(to)], false, &stroke);
        }
    }
}

/// The knots in pixels, thinned out where there are more than can be seen.
fn outline(table: &PiecewiseLinear, x: &Scale, y: &Scale) -> Vec<[f64; 2]> {
    let knots: Vec<(f64, f64)> = table.knots().collect();
    let pixel = |&(nm, value): &(f64, f64)| [x.at(nm), y.at(value)];
    if knots.len() <= MAX_POINTS {
        return knots.iter().map(pixel).collect();
    }
    let size = knots.len().div_ceil(MAX_POINTS / 2);
    let ends = |column: &[(f64, f64)]| {
        let least = column.iter().min_by(|a, b| a.1.total_cmp(&b.1)).copied();
        let most = column.iter().max_by(|a, b| a.1.total_cmp(&b.1)).copied();
        let mut pair: Vec<_> = least.into_iter().chain(most).collect();
        pair.sort_by(|a, b| a.0.total_cmp(&b.0));
        pair
    };
    let inner = knots[1..knots.len() - 1].chunks(size).flat_map(ends);
    let all: Vec<_> = knots.iter().take(1).copied().chain(inner).chain(knots.last().copied()).collect();
    all.iter().map(pixel).collect()
}

/// Names of a few curves with their lines, in the header.
fn legend(plot: &Plot, canvas: &mut Canvas) {
    let mut left = 28.0;
    let at = 80.0;
    for (curve, line) in plot.curves.iter().zip(paint::LINES) {
        let (line, fill) = (paint::hex(line), paint::hex(curve.color));
        canvas.raw(&format!(
            r#"<circle cx="{}" cy="{at}" r="6" fill="{fill}" stroke="{line}" stroke-width="3"/>"#,
            left + 7.0
        ));
        let name = shortened(curve.name, 18);
        canvas.text("note", [left + 20.0, at + 4.5], Anchor::Start, &name);
        left += 46.0 + 7.2 * name.chars().count() as f64;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dense_table_is_thinned_without_losing_its_peak() {
        let knots: Vec<f64> = (0..100_000).map(|i| 380.0 + 0.004 * f64::from(i)).collect();
        let values = knots.iter().map(|&nm| if (nm - 546.1).abs() < 0.003 { 7.0 } else { 0.5 }).collect();
        let table = PiecewiseLinear::new(knots, values).unwrap();
        let unit = Scale::new([0.0, 1.0], [0.0, 1.0]);
        let points = outline(&table, &unit, &unit);
        assert!(points.len() <= MAX_POINTS + 2, "{}", points.len());
        assert_eq!(points.iter().map(|p| p[1]).fold(0.0, f64::max), 7.0);
        assert!(points.windows(2).all(|p| p[0][0] <= p[1][0]));
    }
}
