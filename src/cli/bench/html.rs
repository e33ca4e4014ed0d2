//! The benchmark as one HTML file that needs no other.

use super::plot::{self, escaped};
use super::table::columns;
use super::{SceneReport, Session};
use crate::cli::heat;
use crate::develop::{self, Picture, Tonemap};
use crate::io::png;
use crate::metrics::{self, Pair};
use crate::{Image, Result};

const STYLE: &str = "body{font:15px/1.45 system-ui,sans-serif;margin:2rem auto;max-width:76rem;padding:0 1rem;color:#222}\
h1{font-size:1.5rem}h2{font-size:1.2rem;margin-top:2.5rem}table{border-collapse:collapse;font-variant-numeric:tabular-nums}\
th,td{padding:.3rem .7rem;border-bottom:1px solid #ddd;text-align:left}th{font-weight:600}\
.row{display:flex;flex-wrap:wrap;gap:1rem}.row>*{flex:1 1 24rem;max-width:36rem}figure{margin:0}\
.pictures>*{flex:0 1 auto}img{max-width:100%;image-rendering:pixelated;display:block}figcaption{font-size:.85rem;color:#555}\
.note{color:#555;font-size:.9rem}";

const BY_TIME: [&str; 2] = ["CPU seconds", "relMSE"];
const BY_SAMPLES: [&str; 2] = ["samples per pixel", "relMSE"];

/// The page.
pub fn page(session: &Session, reports: &[SceneReport]) -> Result<String> {
    let mut body = String::new();
    for report in reports {
        body += &scene(session, report)?;
    }
    let args = session.args;
    let clock =
        if session.clock.is_known() { "CPU seconds are of the whole process" } else { "CPU seconds are wall time" };
    Ok(format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>abbe bench</title>\
         <meta name=\"viewport\" content=\"width=device-width\"><style>{STYLE}</style></head><body>\n\
         <h1>Run time against error</h1>\n<p class=\"note\">{}, {} threads, {} independent runs of each budget, taken in turns. \
         {clock}. relMSE is the mean over pixels and X, Y, Z of (I − R)² / (R² + 0.01 m²), m the mean of R, less the \
         reference's own; bars are standard errors, ranges 95 % intervals. The cost is fitted as fixed + per sample; other \
         programs' fixed cost holds their start and the reading of the scene.</p>\n{body}</body></html>\n",
        crate::VERSION,
        session.pool.current_num_threads(),
        args.replicates
    ))
}

/// The page's plot of error over time of one scene, as a file of its own; `None` if there is nothing to show.
pub fn plot_file(session: &Session, report: &SceneReport) -> Option<String> {
    let title = format!("{}, {} × {}", report.name, report.width, report.height);
    plot::log_log_file(&title, &plot::errors_over(report, |l| l.cpu_seconds), BY_TIME, &session.targets)
}

fn scene(session: &Session, report: &SceneReport) -> Result<String> {
    let by_time = plot::log_log(&plot::errors_over(report, |l| l.cpu_seconds), BY_TIME, &session.targets);
    let by_samples = plot::log_log(&plot::errors_over(report, |l| l.spp as f64), BY_SAMPLES, &session.targets);
    Ok(format!(
        "<h2>{}, {} × {}</h2>\n<p class=\"note\">{}. Scene compiled in {:.2} s.</p>\n{}\n\
         <div class=\"row\">\n{by_time}{by_samples}</div>\n<h3>Pictures</h3>\n<div class=\"row pictures\">\n{}</div>\n",
        escaped(&report.name),
        report.width,
        report.height,
        escaped(&report.reference.told()),
        report.compile_seconds,
        table(session, report),
        pictures(report)?
    ))
}

fn table(session: &Session, report: &SceneReport) -> String {
    let columns = columns(session, report);
    let heads: String = columns.iter().map(|(head, _)| format!("<th>{}</th>", escaped(head))).collect();
    let row =
        |i: usize| -> String { columns.iter().map(|(_, cells)| format!("<td>{}</td>", escaped(&cells[i]))).collect() };
    let rows: String = (0..report.variants.len()).map(|i| format!("<tr>{}</tr>\n", row(i))).collect();
    format!("<table><tr>{heads}</tr>\n{rows}</table>")
}

/// The reference, and for each variant a picture of its largest budget beside its error.
fn pictures(report: &SceneReport) -> Result<String> {
    let exposure_ev = develop::automatic_exposure(&report.reference.mean);
    let shown = |xyz: &Image| png_uri(&develop::develop(xyz, Some(exposure_ev), Tonemap::Srgb));
    let mut text = figure(&shown(&report.reference.mean)?, "reference");
    for v in &report.variants {
        let Some(picture) = &v.picture else { continue };
        let pair = Pair::new(picture, &report.reference.mean, None)?;
        let error = png_uri(&heat::picture(&metrics::relative_error_map(&pair), 0, 1.0))?;
        let spp = v.levels.last().map_or(0, |level| level.spp);
        let name = escaped(&v.variant.name);
        text += &figure(&shown(picture)?, &format!("{name}, {spp} samples per pixel"));
        text += &figure(&error, &format!("{name}: relative error, white is 100 %"));
    }
    Ok(text)
}

fn figure(uri: &str, caption: &str) -> String {
    format!("<figure><img alt=\"{caption}\" src=\"{uri}\"><figcaption>{caption}</figcaption></figure>\n")
}

fn png_uri(picture: &Picture) -> Result<String> {
    Ok(format!("data:image/png;base64,{}", base64(&png::encode(picture)?)))
}

/// RFC 4648.
fn base64(bytes: &[u8]) -> String {
    const ALPHABET: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let word = (0..3).fold(0u32, |word, i| word << 8 | u32::from(chunk.get(i).copied().unwrap_or(0)));
        for i in 0..4 {
            let letter = ALPHABET[(word >> (18 - 6 * i)) as usize & 63];
            text.push(if i <= chunk.len() { char::from(letter) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_of_rfc_4648() {
        let of = ["", "f", "fo", "foo", "foob", "fooba", "foobar"].map(|text| base64(text.as_bytes()));
        assert_eq!(of, ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"]);
    }
}
