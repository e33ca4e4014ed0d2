//! Spectra and their chromaticities as one SVG: a card that is readable on light and on dark pages, and follows the
//! reader's preference where the viewer knows it.

mod chromaticity;
mod curves;
mod paint;
mod scale;
mod svg;

use crate::Result;
use crate::cli::usage;
use crate::color::{Observer, RgbSpace};
use crate::spectrum::PiecewiseLinear;
pub use paint::hex;
use std::path::Path;
use svg::{Anchor, Canvas};

/// Width and height of the card, pixels.
const SIZE: [f64; 2] = [1000.0, 480.0];
/// Top and bottom of both panels, pixels.
const PANEL_Y: [f64; 2] = [104.0, 424.0];
/// Left and right of the panel of curves, pixels.
const CURVES_X: [f64; 2] = [76.0, 580.0];
/// Left of the chromaticity diagram, pixels.
const CHROMATICITY_X: f64 = 664.0;

/// Colours and strokes; the second set is for readers who prefer dark pages.
const STYLE: &str = "\
text{font-family:'Inter','Helvetica Neue','Segoe UI','DejaVu Sans',Arial,sans-serif;font-size:12px;fill:#3d4754}
.title{font-size:19px;font-weight:600;fill:#171c23}.note{font-size:12.5px}.small{font-size:10.5px;fill:#5d6875}
.card{fill:#fdfdfe;stroke:#d5dae1}.grid{stroke:#dfe3e9}.axis{stroke:#8b95a1;fill:none}
.curve{fill:none;stroke:#171c23;stroke-width:1.8;stroke-linejoin:round}.held{stroke-dasharray:2 4}
.casing{fill:none;stroke:#171c23;stroke-opacity:.45;stroke-width:3.4;stroke-linejoin:round}
.lamp{fill:none;stroke:#7b8693;stroke-width:1.1;stroke-dasharray:5 3}
.locus{fill:none;stroke:#4a5461;stroke-width:1.4;stroke-linejoin:round}.planck{fill:none;stroke:#171c23;stroke-width:1.3}
.gamut{fill:none;stroke:#171c23;stroke-opacity:.55;stroke-width:1;stroke-dasharray:4 3}
.white{fill:none;stroke:#171c23;stroke-width:1.3}.dominant{fill:none;stroke:#171c23;stroke-width:1;stroke-dasharray:2 3}
.halo{fill:none;stroke:#fdfdfe;stroke-width:4}.point{stroke:#171c23;stroke-width:1.5}.chip{stroke:#8b95a1;stroke-width:.8}
.tint{opacity:.8}.dot{fill:#171c23}
.halo-text{paint-order:stroke;stroke:#fdfdfe;stroke-opacity:.55;stroke-width:3px;fill:#171c23}
@media (prefers-color-scheme:dark){text{fill:#c3cad3}.title{fill:#f1f4f7}.small{fill:#98a3af}
.card{fill:#14181d;stroke:#333b45}.grid{stroke:#2a313a}.axis{stroke:#69737f}.curve,.casing,.planck,.white,.point{stroke:#f1f4f7}
.gamut,.dominant{stroke:#f1f4f7}.lamp{stroke:#8993a0}.locus{stroke:#a9b3bf}.halo{stroke:#14181d}.dot{fill:#f1f4f7}
.halo-text{stroke:#14181d;fill:#f1f4f7}.tint{opacity:.62}}";

/// What is drawn.
#[derive(Debug)]
pub struct Plot<'a> {
    /// The card's title.
    pub title: String,
    /// Up to two lines below it.
    pub notes: Vec<String>,
    /// What the values are, with their unit.
    pub value_label: &'static str,
    /// Whether the values are shares, shown over 0…1 at least.
    pub values_are_shares: bool,
    /// At least one.
    pub curves: Vec<Curve<'a>>,
    /// The light that a reflectance or transmittance stands in.
    pub lamp: Option<(&'a str, PiecewiseLinear)>,
    /// Observer whose chromaticity diagram is drawn.
    pub observer: &'a Observer,
    /// The space whose triangle is drawn.
    pub space: &'a RgbSpace,
    /// Name and chromaticity of the reference white.
    pub white: (&'a str, [f64; 2]),
}

/// One spectrum.
#[derive(Debug)]
pub struct Curve<'a> {
    /// Name of the spectrum.
    pub name: &'a str,
    /// Samples of the spectrum.
    pub table: &'a PiecewiseLinear,
    /// Colour of the spectrum as sRGB.
    pub color: [u8; 3],
    /// Chromaticity of the spectrum; NaN for black.
    pub xy: [f64; 2],
    /// Point at which the line from the white through the chromaticity meets the locus.
    pub dominant_xy: Option<[f64; 2]>,
}

impl Plot<'_> {
    /// The picture.
    pub fn to_svg(&self) -> String {
        let mut canvas = Canvas::default();
        let [width, height] = SIZE.map(svg::number);
        canvas.raw(&format!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" role="img">"#
        ));
        canvas.raw(&format!("<title>{}</title>", svg::escaped(&self.title)));
        canvas.raw(&format!("<style>{STYLE}</style>"));
        let (w, h) = (svg::number(SIZE[0] - 1.0), svg::number(SIZE[1] - 1.0));
        canvas.raw(&format!(r#"<rect class="card" x="0.5" y="0.5" width="{w}" height="{h}" rx="10"/>"#));
        self.header(&mut canvas);
        curves::draw(self, &mut canvas);
        chromaticity::draw(self, &mut canvas);
        canvas.raw("</svg>");
        canvas.finish()
    }

    /// Whether the curves are few enough to be told apart by name; else each has its own colour.
    fn are_named(&self) -> bool {
        self.curves.len() <= paint::LINES.len()
    }

    fn header(&self, canvas: &mut Canvas) {
        let mut left = 28.0;
        if let [curve] = self.curves.as_slice() {
            let fill = paint::hex(curve.color);
            canvas
                .raw(&format!(r#"<rect class="chip" x="{left}" y="22" width="44" height="44" rx="6" fill="{fill}"/>"#));
            left += 60.0;
        }
        canvas.text("title", [left, 38.0], Anchor::Start, &shortened(&self.title, 80));
        for (i, note) in self.notes.iter().take(2).enumerate() {
            canvas.text("note", [left, 58.0 + 18.0 * i as f64], Anchor::Start, &shortened(note, 140));
        }
    }
}

/// Refuses names of pictures that are no SVG.
///
/// # Errors
/// `Usage`.
pub fn check_name(path: &Path) -> Result<()> {
    let is_svg = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("svg"));
    if is_svg || path.as_os_str() == "-" {
        return Ok(());
    }
    Err(usage(format!("--plot {}: expected a name that ends in .svg, or -", path.display())))
}

/// At most so many characters.
fn shortened(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        Some(_) => text.chars().take(most - 1).chain(['…']).collect(),
        None => text.to_owned(),
    }
}
