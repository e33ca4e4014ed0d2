//! Writing SVG: a string of elements, numbers with as many digits as can be seen, text escaped.

use std::fmt::Write;

/// Elements drawn so far.
#[derive(Debug, Default)]
pub struct Canvas {
    body: String,
}

/// Where a text stands in relation to its point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// The text starts at the point.
    Start,
    /// The text is centred on the point.
    Middle,
    /// The text ends at the point.
    End,
}

impl Canvas {
    /// Adds an element or text as it is.
    pub fn raw(&mut self, element: &str) {
        self.body.push_str(element);
        self.body.push('\n');
    }

    /// A straight line.
    pub fn line(&mut self, class: &str, [x1, y1]: [f64; 2], [x2, y2]: [f64; 2]) {
        let [x1, y1, x2, y2] = [x1, y1, x2, y2].map(number);
        self.raw(&format!(r#"<path class="{class}" d="M{x1} {y1}L{x2} {y2}"/>"#));
    }

    /// A polyline, closed or open; `extra` holds further attributes.
    pub fn path(&mut self, class: &str, points: &[[f64; 2]], closed: bool, extra: &str) {
        let data = path_data(points, closed);
        self.raw(&format!(r#"<path class="{class}" d="{data}"{extra}/>"#));
    }

    /// A circle; `extra` holds further attributes.
    pub fn circle(&mut self, class: &str, [x, y]: [f64; 2], radius: f64, extra: &str) {
        let [x, y, r] = [x, y, radius].map(number);
        self.raw(&format!(r#"<circle class="{class}" cx="{x}" cy="{y}" r="{r}"{extra}/>"#));
    }

    /// A text.
    pub fn text(&mut self, class: &str, [x, y]: [f64; 2], anchor: Anchor, text: &str) {
        let anchor = match anchor {
            Anchor::Start => "",
            Anchor::Middle => r#" text-anchor="middle""#,
            Anchor::End => r#" text-anchor="end""#,
        };
        let ([x, y], text) = ([x, y].map(number), escaped(text));
        self.raw(&format!(r#"<text class="{class}" x="{x}" y="{y}"{anchor}>{text}</text>"#));
    }

    /// Everything drawn.
    pub fn finish(self) -> String {
        self.body
    }
}

/// The `d` of a polyline.
pub fn path_data(points: &[[f64; 2]], closed: bool) -> String {
    let mut data = String::with_capacity(points.len() * 14);
    for (i, &[x, y]) in points.iter().enumerate() {
        let command = if i == 0 { 'M' } else { 'L' };
        // Writing to a string does not fail.
        let _ = write!(data, "{command}{} {}", number(x), number(y));
    }
    if closed {
        data.push('Z');
    }
    data
}

/// Hundredths of a pixel, without zeros at the end.
pub fn number(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Text as it stands in XML. Control characters, which XML cannot hold, become blanks.
pub fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c if c.is_control() || c == '\u{fffe}' || c == '\u{ffff}' => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        assert_eq!([1.0, 0.5, -0.001, 12.345_6, 100.0].map(number), ["1", "0.5", "0", "12.35", "100"]);
    }

    #[test]
    fn text_cannot_break_out() {
        let mut canvas = Canvas::default();
        canvas.text("a", [1.0, 2.0], Anchor::End, "<\"x\" & \u{1b}[0m>");
        let expected =
            "<text class=\"a\" x=\"1\" y=\"2\" text-anchor=\"end\">&lt;&quot;x&quot; &amp;  [0m&gt;</text>\n";
        assert_eq!(canvas.finish(), expected);
    }

    #[test]
    fn paths_start_with_a_move() {
        assert_eq!(path_data(&[[0.0, 1.0], [2.0, 3.5]], true), "M0 1L2 3.5Z");
    }
}
