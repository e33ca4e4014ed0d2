//! Log–log plots as SVG.

use super::SceneReport;
use super::summary::Level;
use std::fmt::Write;

/// A line with its points.
pub struct Series {
    /// Name in the legend.
    pub name: String,
    /// x, y, and the ends of y's interval.
    pub points: Vec<(f64, f64, [f64; 2])>,
}

/// The error of each variant of a scene over `x`, with standard errors.
pub fn errors_over(report: &SceneReport, x: impl Fn(&Level) -> f64) -> Vec<Series> {
    let point = |l: &Level| (x(l), l.relmse, [l.relmse - l.standard_error, l.relmse + l.standard_error]);
    let series = |v: &super::VariantReport| Series {
        name: v.variant.name.clone(),
        points: v.levels.iter().map(point).collect(),
    };
    report.variants.iter().map(series).collect()
}

/// Colours that people with any kind of colour vision tell apart (after Okabe and Ito).
const COLORS: [&str; 7] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"];

/// The colour of a series.
pub fn color(index: usize) -> &'static str {
    COLORS[index % COLORS.len()]
}

const WIDTH: f64 = 560.0;
const HEIGHT: f64 = 380.0;
/// Left, top, right, bottom.
const MARGINS: [f64; 4] = [64.0, 14.0, 14.0, 46.0];

/// One axis: log₁₀ of its ends, and where they are on the page.
struct Axis {
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Axis {
    fn new(values: impl Iterator<Item = f64>, from: f64, to: f64) -> Option<Self> {
        let logs: Vec<f64> = values.filter(|v| *v > 0.0 && v.is_finite()).map(log10).collect();
        let low = logs.iter().copied().reduce(f64::min)?;
        let high = logs.iter().copied().reduce(f64::max)?;
        // Some air, and at least half a decade.
        let pad = (0.04 * (high - low)).max(0.5 * (0.5 - (high - low))).max(0.03);
        Some(Self { low: low - pad, high: high + pad, from, to })
    }

    fn at(&self, value: f64) -> f64 {
        let share = (log10(value.max(f64::MIN_POSITIVE)) - self.low) / (self.high - self.low);
        self.from + (self.to - self.from) * share.clamp(-0.02, 1.02)
    }

    /// Values with a line, and whether they get a number.
    fn ticks(&self) -> Vec<(f64, bool)> {
        let decades = self.low.floor() as i32..=self.high.ceil() as i32;
        let few = self.high - self.low < 2.0;
        let every = (((self.high - self.low) / 8.0).ceil() as i32).max(1);
        let mut ticks = Vec::new();
        for decade in decades {
            for digit in 1..10 {
                let value: f64 = format!("{digit}e{decade}").parse().unwrap_or(f64::NAN);
                if (self.low..=self.high).contains(&log10(value)) {
                    let main = digit == 1 && decade % every == 0;
                    ticks.push((value, main || (few && [2, 5].contains(&digit))));
                }
            }
        }
        ticks
    }
}

fn log10(value: f64) -> f64 {
    crate::math::ln(value) / std::f64::consts::LN_10
}

/// A number on an axis.
fn label(value: f64) -> String {
    if (1e-2..1e5).contains(&value) { format!("{value}") } else { format!("{value:e}") }
}

/// A plot with horizontal dashed lines at `targets`, for a page that says how large it is. Empty if there is nothing to
/// show.
pub fn log_log(series: &[Series], labels: [&str; 2], targets: &[f64]) -> String {
    let Some(drawing) = drawing(series, labels, targets) else { return String::new() };
    format!("<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" {}>\n{drawing}</svg>\n", attributes(labels))
}

/// The same as a file of its own: with a size, on white, under a title. `None` if there is nothing to show.
pub fn log_log_file(title: &str, series: &[Series], labels: [&str; 2], targets: &[f64]) -> Option<String> {
    const ABOVE: f64 = 24.0;
    let (drawing, height) = (drawing(series, labels, targets)?, HEIGHT + ABOVE);
    let attributes = attributes(labels);
    Some(format!(
        "<svg width=\"{WIDTH}\" height=\"{height}\" viewBox=\"0 {top} {WIDTH} {height}\" {attributes}>\n\
         <rect y=\"{top}\" width=\"{WIDTH}\" height=\"{height}\" fill=\"#fff\"/>\n\
         <text x=\"{middle}\" y=\"-5\" text-anchor=\"middle\" font-size=\"14\" font-weight=\"600\">{title}</text>\n\
         {drawing}</svg>\n",
        top = -ABOVE,
        middle = (WIDTH + MARGINS[0] - MARGINS[2]) / 2.0,
        title = escaped(title),
    ))
}

fn attributes(labels: [&str; 2]) -> String {
    format!(
        "role=\"img\" aria-label=\"{} against {}\" xmlns=\"http://www.w3.org/2000/svg\" \
         font-family=\"system-ui, sans-serif\" font-size=\"12\"",
        labels[1], labels[0]
    )
}

/// What is inside of either.
fn drawing(series: &[Series], labels: [&str; 2], targets: &[f64]) -> Option<String> {
    let points = || series.iter().flat_map(|s| &s.points);
    let [left, top, right, bottom] = MARGINS;
    let x = Axis::new(points().map(|p| p.0), left, WIDTH - right)?;
    let y = Axis::new(points().map(|p| p.1).chain(targets.iter().copied()), HEIGHT - bottom, top)?;
    let mut svg = String::new();
    grid(&mut svg, &x, &y, labels);
    for &target in targets {
        // Writing to a String cannot fail; so below.
        let _ = writeln!(
            svg,
            "<line x1=\"{left}\" x2=\"{:.1}\" y1=\"{1:.1}\" y2=\"{1:.1}\" stroke=\"#777\" stroke-dasharray=\"5 4\"/>",
            WIDTH - right,
            y.at(target)
        );
    }
    for (i, one) in series.iter().enumerate() {
        draw(&mut svg, one, color(i), &x, &y);
    }
    legend(&mut svg, series);
    Some(svg)
}

fn grid(svg: &mut String, x: &Axis, y: &Axis, labels: [&str; 2]) {
    let [left, top, right, bottom] = MARGINS;
    let (x_end, y_end) = (WIDTH - right, HEIGHT - bottom);
    for (value, numbered) in x.ticks() {
        let (at, shade) = (x.at(value), if numbered { "#ddd" } else { "#f1f1f1" });
        let _ = writeln!(svg, "<path d=\"M{at:.1} {top}V{y_end}\" stroke=\"{shade}\"/>");
        if numbered {
            let under = y_end + 16.0;
            let _ = writeln!(svg, "<text x=\"{at:.1}\" y=\"{under}\" text-anchor=\"middle\">{}</text>", label(value));
        }
    }
    for (value, numbered) in y.ticks() {
        let (at, shade) = (y.at(value), if numbered { "#ddd" } else { "#f1f1f1" });
        let _ = writeln!(svg, "<path d=\"M{left} {at:.1}H{x_end}\" stroke=\"{shade}\"/>");
        if numbered {
            let (beside, middle) = (left - 7.0, at + 4.0);
            let _ = writeln!(svg, "<text x=\"{beside}\" y=\"{middle:.1}\" text-anchor=\"end\">{}</text>", label(value));
        }
    }
    let (width, height) = (x_end - left, y_end - top);
    let _ = writeln!(
        svg,
        "<rect x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" fill=\"none\" stroke=\"#444\"/>\n\
         <text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n\
         <text transform=\"translate(14 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
        left + width / 2.0,
        HEIGHT - 8.0,
        labels[0],
        top + height / 2.0,
        labels[1]
    );
}

fn draw(svg: &mut String, series: &Series, color: &str, x: &Axis, y: &Axis) {
    let shown: Vec<_> = series.points.iter().filter(|p| p.0 > 0.0 && p.1 > 0.0).collect();
    let path: Vec<String> = shown.iter().map(|p| format!("{:.1},{:.1}", x.at(p.0), y.at(p.1))).collect();
    let line = path.join(" ");
    let _ = writeln!(svg, "<polyline points=\"{line}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"2\"/>");
    for (px, py, [low, high]) in shown {
        let (at, from, to) = (x.at(*px), y.at(*low), y.at(*high));
        let _ = writeln!(
            svg,
            "<path d=\"M{at:.1} {from:.1}V{to:.1}\" stroke=\"{color}\"/><circle cx=\"{at:.1}\" cy=\"{:.1}\" r=\"3.2\" \
             fill=\"{color}\"/>",
            y.at(*py)
        );
    }
}

/// Lower left, where falling curves leave room.
fn legend(svg: &mut String, series: &[Series]) {
    let [left, _, _, bottom] = MARGINS;
    for (i, one) in series.iter().enumerate() {
        let y = HEIGHT - bottom - 12.0 - 17.0 * (series.len() - 1 - i) as f64;
        let _ = writeln!(
            svg,
            "<path d=\"M{} {1:.1}h22\" stroke=\"{2}\" stroke-width=\"2.5\"/><text x=\"{3}\" y=\"{4:.1}\">{5}</text>",
            left + 10.0,
            y - 4.0,
            color(i),
            left + 38.0,
            y,
            escaped(&one.name)
        );
    }
}

/// Text inside HTML and SVG.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_lie_where_they_should() {
        let axis = Axis { low: -2.0, high: 2.0, from: 0.0, to: 100.0 };
        assert_eq!([0.01, 1.0, 100.0].map(|v| axis.at(v)), [0.0, 50.0, 100.0]);
        let numbered: Vec<f64> = axis.ticks().into_iter().filter(|t| t.1).map(|t| t.0).collect();
        assert_eq!(numbered, [0.01, 0.1, 1.0, 10.0, 100.0]);
        let series = Series { name: "a<b".into(), points: vec![(1.0, 0.1, [0.05, 0.2]), (10.0, 0.01, [0.0, 0.02])] };
        let series = [series];
        let svg = log_log(&series, ["x", "y"], &[0.01]);
        assert!(svg.contains("a&lt;b") && svg.matches("<circle").count() == 2 && !svg.contains("NaN"), "{svg}");
        assert_eq!(log_log(&[], ["x", "y"], &[0.01]), "");
        // A file shows the same, and its title.
        let file = log_log_file("c&d", &series, ["x", "y"], &[0.01]).unwrap();
        assert!(file.contains("c&amp;d") && file.contains(svg.split_once('\n').unwrap().1), "{file}");
        assert_eq!(log_log_file("none", &[], ["x", "y"], &[0.01]), None);
    }
}
