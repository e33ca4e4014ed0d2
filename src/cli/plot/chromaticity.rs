//! The chromaticity diagram: spectral locus, Planckian locus, the space's triangle, the white, and the points.

use super::scale::Scale;
use super::svg::{Anchor, Canvas, number, path_data};
use super::{CHROMATICITY_X, PANEL_Y, Plot, paint, shortened};
use crate::color::temperature::{PlanckianLocus, xy_from_uv};
use crate::color::{Observer, chromaticity, xyz_from_xy};

/// Largest x and y shown.
const RANGE: [f64; 2] = [0.8, 0.9];
/// Wavelengths of the locus, nm: beyond 700 nm it stands still.
const LOCUS_NM: [u32; 2] = [380, 700];
/// Side of a cell of the tint, in x and y; blurred afterwards.
const CELL: f64 = 0.02;
/// Labelled wavelengths on the locus, nm.
const LABELS_NM: [u32; 12] = [470, 480, 490, 500, 510, 520, 540, 560, 580, 600, 620, 700];
/// Labelled temperatures on the Planckian locus, K.
const LABELS_KELVIN: [f64; 3] = [3000.0, 5000.0, 10_000.0];

/// Maps x, y to pixels, at the same scale along both axes.
struct Diagram {
    x: Scale,
    y: Scale,
}

impl Diagram {
    fn new() -> Self {
        let height = PANEL_Y[1] - PANEL_Y[0];
        let width = height * RANGE[0] / RANGE[1];
        Self {
            x: Scale::new([0.0, RANGE[0]], [CHROMATICITY_X, CHROMATICITY_X + width]),
            y: Scale::new([0.0, RANGE[1]], [PANEL_Y[1], PANEL_Y[0]]),
        }
    }

    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.x.at(x), self.y.at(y)]
    }
}

/// Draws the diagram.
pub fn draw(plot: &Plot, canvas: &mut Canvas) {
    let diagram = Diagram::new();
    let locus = locus(plot.observer);
    axes(canvas, &diagram);
    tint(canvas, &diagram, &locus);
    draw_locus(canvas, &diagram, &locus);
    let triangle = plot.space.primaries.map(|xy| diagram.at(xy));
    canvas.path("gamut", &triangle, true, "");
    draw_planckian(canvas, &diagram, plot.observer);
    draw_white(plot, canvas, &diagram);
    draw_points(plot, canvas, &diagram);
    legend(plot, canvas, &diagram);
}

/// Wavelengths in nm with their chromaticities, as far as the observer sees them.
fn locus(observer: &Observer) -> Vec<(u32, [f64; 2])> {
    let points = (LOCUS_NM[0]..=LOCUS_NM[1]).map(|nm| (nm, chromaticity(observer.eval(f64::from(nm)))));
    points.filter(|(_, xy)| xy[0].is_finite()).collect()
}

/// A faint fill with the colours of the diagram: flat cells, blurred into each other and clipped to the locus.
fn tint(canvas: &mut Canvas, diagram: &Diagram, locus: &[(u32, [f64; 2])]) {
    let outline: Vec<_> = locus.iter().map(|(_, xy)| diagram.at(*xy)).collect();
    let blur = number(diagram.x.at(0.55 * CELL) - diagram.x.at(0.0));
    canvas.raw(&format!(
        r#"<clipPath id="locus"><path d="{}"/></clipPath><filter id="blur"><feGaussianBlur stdDeviation="{blur}"/></filter>"#,
        path_data(&outline, true)
    ));
    canvas.raw(r#"<g class="tint" clip-path="url(#locus)"><g filter="url(#blur)">"#);
    // Half a pixel more than the cell: no seams.
    let side = number(diagram.x.at(CELL) - diagram.x.at(0.0) + 0.5);
    let inside: Vec<_> = locus.iter().map(|(_, xy)| *xy).collect();
    for row in 0..=(RANGE[1] / CELL) as usize {
        for column in 0..=(RANGE[0] / CELL) as usize {
            let corner = [column as f64 * CELL, row as f64 * CELL];
            let center = corner.map(|c| c + 0.5 * CELL);
            // The cells around the locus have to be there, too, or the blur would fade it.
            let near = [[0.0, 0.0], [-2.0, 0.0], [2.0, 0.0], [0.0, -2.0], [0.0, 2.0]];
            if near.iter().any(|d| is_inside(&inside, [center[0] + d[0] * CELL, center[1] + d[1] * CELL])) {
                let [x, y] = diagram.at([corner[0], corner[1] + CELL]).map(number);
                let fill = paint::hex(paint::brightest(xyz_from_xy(center), 1.0));
                canvas.raw(&format!(r#"<path fill="{fill}" d="M{x} {y}h{side}v{side}h-{side}z"/>"#));
            }
        }
    }
    canvas.raw("</g></g>");
}

/// Whether a point lies inside a closed polygon (even–odd rule).
fn is_inside(polygon: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let mut inside = false;
    for (i, &[x1, y1]) in polygon.iter().enumerate() {
        let [x2, y2] = polygon[(i + 1) % polygon.len()];
        if (y1 > y) != (y2 > y) && x < x1 + (y - y1) / (y2 - y1) * (x2 - x1) {
            inside = !inside;
        }
    }
    inside
}

fn axes(canvas: &mut Canvas, diagram: &Diagram) {
    for i in 0..=8 {
        let (value, label) = (f64::from(i) / 10.0, format!("{:.1}", f64::from(i) / 10.0));
        let [x, bottom] = diagram.at([value, 0.0]);
        let [left, y] = diagram.at([0.0, value]);
        let class = if i == 0 { "axis" } else { "grid" };
        canvas.line(class, [x, bottom], [x, PANEL_Y[0]]);
        canvas.line(class, [left, y], [diagram.x.at(RANGE[0]), y]);
        if i % 2 == 0 {
            canvas.text("small", [x, bottom + 16.0], Anchor::Middle, &label);
            canvas.text("small", [left - 8.0, y + 3.5], Anchor::End, &label);
        }
    }
    let middle = diagram.at([0.5 * RANGE[0], 0.5 * RANGE[1]]);
    canvas.text("note", [middle[0], PANEL_Y[1] + 36.0], Anchor::Middle, "x");
    canvas.text("note", [CHROMATICITY_X - 40.0, middle[1]], Anchor::Middle, "y");
}

fn draw_locus(canvas: &mut Canvas, diagram: &Diagram, locus: &[(u32, [f64; 2])]) {
    let outline: Vec<_> = locus.iter().map(|(_, xy)| diagram.at(*xy)).collect();
    canvas.path("locus", &outline, true, "");
    for (i, &(nm, xy)) in locus.iter().enumerate() {
        if !LABELS_NM.contains(&nm) {
            continue;
        }
        let at = diagram.at(xy);
        let [out_x, out_y] = outward(&outline, i);
        canvas.line("locus", at, [at[0] + 4.0 * out_x, at[1] + 4.0 * out_y]);
        let anchor = match out_x {
            -0.5..=0.5 => Anchor::Middle,
            x if x < 0.0 => Anchor::End,
            _ => Anchor::Start,
        };
        let below = if out_y > 0.5 { 8.0 } else { 3.5 };
        canvas.text("small", [at[0] + 8.0 * out_x, at[1] + 8.0 * out_y + below], anchor, &nm.to_string());
    }
}

/// The unit normal of the locus at a point, away from the diagram's inside, in pixels.
fn outward(outline: &[[f64; 2]], i: usize) -> [f64; 2] {
    let before = outline[i.saturating_sub(4)];
    let after = outline[(i + 4).min(outline.len() - 1)];
    let [dx, dy] = [after[0] - before[0], after[1] - before[1]];
    let length = dx.hypot(dy).max(f64::MIN_POSITIVE);
    // The locus runs clockwise on the page.
    [dy / length, -dx / length]
}

fn draw_planckian(canvas: &mut Canvas, diagram: &Diagram, observer: &Observer) {
    let planckian = PlanckianLocus::new(observer);
    let at = |kelvin| planckian.uv(kelvin).ok().map(|uv| diagram.at(xy_from_uv(uv)));
    // Steps of reciprocal temperature look even: from 25 000 K to 1000 K.
    let points: Vec<_> = (0..=48).filter_map(|i| at(1e6 / (40.0 + 20.0 * f64::from(i)))).collect();
    canvas.path("planck", &points, false, "");
    for kelvin in LABELS_KELVIN {
        let Some(at) = at(kelvin) else { continue };
        canvas.circle("dot", at, 2.0, "");
        canvas.text("small halo-text", [at[0] + 3.0, at[1] + 14.0], Anchor::Start, &format!("{kelvin} K"));
    }
}

fn draw_white(plot: &Plot, canvas: &mut Canvas, diagram: &Diagram) {
    let [x, y] = diagram.at(plot.white.1);
    cross(canvas, [x, y]);
}

fn cross(canvas: &mut Canvas, [x, y]: [f64; 2]) {
    canvas.line("white", [x - 4.0, y - 4.0], [x + 4.0, y + 4.0]);
    canvas.line("white", [x - 4.0, y + 4.0], [x + 4.0, y - 4.0]);
}

/// What the marks are, in the corner that no light reaches.
fn legend(plot: &Plot, canvas: &mut Canvas, diagram: &Diagram) {
    let [left, top] = diagram.at([0.5, 0.87]);
    let row = |i: f64| top + 17.0 * i;
    cross(canvas, [left, row(0.0)]);
    canvas.line("gamut", [left - 9.0, row(1.0)], [left + 9.0, row(1.0)]);
    canvas.line("planck", [left - 9.0, row(2.0)], [left + 9.0, row(2.0)]);
    let names = [shortened(plot.white.0, 16), plot.space.name.to_owned(), "Planckian locus".to_owned()];
    for (i, name) in names.iter().enumerate() {
        canvas.text("small", [left + 16.0, row(i as f64) + 3.5], Anchor::Start, name);
    }
}

fn draw_points(plot: &Plot, canvas: &mut Canvas, diagram: &Diagram) {
    for (i, curve) in plot.curves.iter().enumerate().filter(|(_, curve)| curve.xy[0].is_finite()) {
        let at = diagram.at(curve.xy);
        if let Some(dominant) = curve.dominant_xy {
            canvas.path("dominant", &[diagram.at(plot.white.1), diagram.at(dominant)], false, "");
        }
        let radius = if plot.curves.len() == 1 { 6.0 } else { 4.5 };
        let is_told_apart = plot.curves.len() > 1 && plot.are_named();
        let ring = if is_told_apart {
            format!(r#" style="stroke:{};stroke-width:3""#, paint::hex(paint::LINES[i]))
        } else {
            String::new()
        };
        canvas.circle("halo", at, radius, "");
        canvas.circle("point", at, radius, &format!(r#" fill="{}"{ring}"#, paint::hex(curve.color)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_is_inside_the_locus_and_the_corners_are_not() {
        let polygon: Vec<_> = locus(Observer::cie_1931_2deg()).into_iter().map(|(_, xy)| xy).collect();
        assert!(is_inside(&polygon, [0.3333, 0.3333]));
        assert!(
            !is_inside(&polygon, [0.7, 0.7]) && !is_inside(&polygon, [0.01, 0.01]) && !is_inside(&polygon, [0.6, 0.1])
        );
    }

    #[test]
    fn labels_stand_outside() {
        let locus = locus(Observer::cie_1931_2deg());
        let diagram = Diagram::new();
        let outline: Vec<_> = locus.iter().map(|(_, xy)| diagram.at(*xy)).collect();
        for (i, &(nm, _)) in locus.iter().enumerate().filter(|(_, (nm, _))| LABELS_NM[..11].contains(nm)) {
            let [x, y] = outward(&outline, i);
            assert!(!is_inside(&outline, [outline[i][0] + 6.0 * x, outline[i][1] + 6.0 * y]), "{nm}");
        }
    }
}
