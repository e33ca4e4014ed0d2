//! What `abbe spectrum` prints and draws.

use super::Measured;
use super::light::{LightFacts, Rendering};
use super::measure::{Measurement, Viewing};
use crate::cli::plot::{Curve, Plot, hex};
use crate::cli::swatch;
use crate::color::chroma::Dominant;
use crate::color::chromaticity;
use crate::io::spectrum_file::Quantity;
use serde_json::{Value, json};
use std::path::Path;

fn quantity_name(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Emission => "emission",
        Quantity::Reflectance => "reflectance",
        Quantity::Transmittance => "transmittance",
    }
}

/// One block for a spectrum alone, one line each for many.
pub fn text(viewing: &Viewing, measured: &[Measured], with_swatches: bool) -> String {
    match measured {
        [only] => block(viewing, only, with_swatches),
        many => table(viewing, many, with_swatches),
    }
}

/// How the colours come about, in words.
fn circumstances(viewing: &Viewing) -> String {
    let (kind, observer) = (quantity_name(viewing.quantity), viewing.observer.name());
    match viewing.quantity {
        Quantity::Emission => format!("{kind}, observer {observer}, seen against {}", viewing.lamp.name),
        _ => format!("{kind} under {}, observer {observer}", viewing.lamp.name),
    }
}

fn block(viewing: &Viewing, one: &Measured, with_swatch: bool) -> String {
    let m = &one.measurement;
    let mut rows = vec![("XYZ", triple(m.xyz.to_array()))];
    rows.push(("xy", m.xy.map_or("none (black)".to_owned(), |[x, y]| format!("{x:.6}  {y:.6}"))));
    if m.shown_scale != 1.0 {
        rows.push(("shown", format!("× {}: the largest linear component becomes 1", significant(m.shown_scale, 6))));
    }
    rows.push(("Lab", triple_of(m.lab.to_array(), 4)));
    rows.push(("RGB linear", format!("{}  ({})", triple(m.linear.to_array()), viewing.space.name)));
    rows.push(("RGB encoded", triple(m.encoded.to_array())));
    let moved = if m.in_gamut { "" } else { "  (moved into the gamut)" };
    rows.push(("hex", format!("{}{moved}", hex(m.rgb8))));
    rows.push(("dominant", m.dominant.map_or("none (no hue)".to_owned(), |d| dominant(&d))));
    if let Some(light) = &m.light {
        rows.extend(light_rows(light));
        let efficacy = light.efficacy_lm_per_w.map_or(String::new(), |e| format!("; {} lm/W", significant(e, 5)));
        let luminance = significant(light.luminance, 6);
        rows.push(("luminance", format!("{luminance} cd/m² if the values are W/(m² sr nm){efficacy}")));
    } else {
        let [x, y] = chromaticity(viewing.white_xyz);
        rows.push(("light", format!("{}: xy {x:.6}  {y:.6}", viewing.lamp.name)));
        rows.extend(light_rows(&viewing.lamp_facts));
    }
    let mut text = String::new();
    if with_swatch {
        text += &format!("{}\n", swatch::patch(m.srgb8, 12)).repeat(2);
    }
    text += &format!("{}: {}\n", one.spectrum.name, circumstances(viewing));
    rows.iter().for_each(|(label, value)| text += &format!("{label:<12} {value}\n"));
    text
}

fn dominant(d: &Dominant) -> String {
    let kind = if d.is_complementary { "complementary, " } else { "" };
    format!("{:.2} nm ({kind}purity {:.4})", d.lambda_nm, d.excitation_purity)
}

fn light_rows(light: &LightFacts) -> Vec<(&'static str, String)> {
    // Adding 0 to what has been rounded: no negative zero.
    let duv = light.duv.map(|duv| format!("Duv {:+.5}", (duv * 1e5).round() / 1e5 + 0.0));
    let temperature = match (light.cct_kelvin, duv) {
        (Some(kelvin), Some(duv)) => format!("{kelvin:.1} K, {duv}"),
        (_, Some(duv)) => format!("none ({duv} is too far from the Planckian locus)"),
        _ => "none".to_owned(),
    };
    let mut rows = vec![("CCT", temperature)];
    if let Some(rendering) = &light.rendering {
        let remark = if light.is_white() { "" } else { "  (of little meaning so far from white)" };
        let Rendering { ra, r, rf, rg } = rendering;
        rows.push(("rendering", format!("Ra {ra:.2}, R9 {:.2}, Rf {rf:.2}, Rg {rg:.2}{remark}", r[8])));
    }
    rows
}

/// One line a spectrum: what tells colours apart at a glance.
fn table(viewing: &Viewing, measured: &[Measured], with_swatches: bool) -> String {
    let head = ["", "X", "Y", "Z", "x", "y", "L*", "a*", "b*", "hex"].map(str::to_owned);
    let rows: Vec<[String; 10]> = std::iter::once(head).chain(measured.iter().map(table_row)).collect();
    let widths: Vec<usize> =
        (0..10).map(|c| rows.iter().map(|row| row[c].chars().count()).max().unwrap_or_default()).collect();
    let is_moved = measured.iter().any(|one| !one.measurement.in_gamut);
    let remark = if is_moved { "; * moved into the gamut" } else { "" };
    let mut text = format!("{}, space {}{remark}\n", circumstances(viewing), viewing.space.name);
    for (i, row) in rows.iter().enumerate() {
        if with_swatches {
            let color = i.checked_sub(1).map(|i| measured[i].measurement.srgb8);
            text += &color.map_or("     ".to_owned(), |color| format!("{} ", swatch::patch(color, 4)));
        }
        let name = format!("{:<width$}", row[0], width = widths[0]);
        let cells = (1..10).map(|c| format!("{:>width$}", row[c], width = widths[c]));
        text += [name].into_iter().chain(cells).collect::<Vec<_>>().join("  ").trim_end();
        text.push('\n');
    }
    text
}

fn table_row(one: &Measured) -> [String; 10] {
    let m = &one.measurement;
    let [x, y, z] = m.xyz.to_array().map(|v| significant(v, 6));
    let [cx, cy] = m.xy.map_or(["–", "–"].map(str::to_owned), |xy| xy.map(|v| format!("{v:.5}")));
    let [l, a, b] = m.lab.to_array().map(|v| format!("{v:.3}"));
    let moved = if m.in_gamut { "" } else { "*" };
    [one.spectrum.name.clone(), x, y, z, cx, cy, l, a, b, format!("{}{moved}", hex(m.rgb8))]
}

/// Six digits each; what is rounding beside the largest is 0.
fn triple(values: [f64; 3]) -> String {
    let largest = values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let shown = values.map(|value| if value.abs() < 1e-12 * largest { 0.0 } else { value });
    shown.map(|value| format!("{:>11}", significant(value, 6))).join(" ").trim_start().to_owned()
}

fn triple_of(values: [f64; 3], digits: usize) -> String {
    values.map(|value| format!("{value:>11.digits$}")).join(" ").trim_start().to_owned()
}

/// Fixed notation where that is short, else powers of ten.
fn significant(value: f64, digits: usize) -> String {
    let size = value.abs();
    match size {
        0.0 => "0".to_owned(),
        _ if (1e-4..1e7).contains(&size) => {
            let before = if size >= 1.0 { format!("{:.0}", size.trunc()).len() } else { 0 };
            format!("{value:.*}", digits.saturating_sub(before))
        }
        _ => format!("{value:.*e}", digits - 1),
    }
}

/// One object.
pub fn json(file: &Path, viewing: &Viewing, measured: &[Measured]) -> String {
    let spectra: Vec<Value> = measured.iter().map(spectrum_json).collect();
    let mut light = light_json(&viewing.lamp_facts);
    light["name"] = json!(viewing.lamp.name);
    light["xyz"] = json!(viewing.white_xyz.to_array());
    light["xy"] = json!(chromaticity(viewing.white_xyz));
    let value = json!({
        "file": file.display().to_string(),
        "as": quantity_name(viewing.quantity),
        "observer": viewing.observer.name(),
        "space": viewing.space.name,
        "adaptation": viewing.adaptation.0,
        "illuminant": light,
        "spectra": spectra,
    });
    format!("{value}\n")
}

fn spectrum_json(one: &Measured) -> Value {
    let m: &Measurement = &one.measurement;
    let knots = one.spectrum.table.lambdas_nm();
    let light = m.light.as_ref().map(|facts| {
        let mut light = light_json(facts);
        light["luminance_cd_per_m2"] = json!(facts.luminance);
        light["efficacy_lm_per_w"] = json!(facts.efficacy_lm_per_w);
        light
    });
    let warnings: Vec<Value> = one.findings.iter().map(|f| json!({ "name": f.name, "message": f.message })).collect();
    json!({
        "name": one.spectrum.name,
        "samples": knots.len(),
        "range_nm": [knots[0], knots[knots.len() - 1]],
        "xyz": m.xyz.to_array(),
        "xy": m.xy,
        "lab": m.lab.to_array(),
        "rgb_linear": m.linear.to_array(),
        "shown_scale": m.shown_scale,
        "rgb_encoded": m.encoded.to_array(),
        "hex": hex(m.rgb8),
        "in_gamut": m.in_gamut,
        "dominant": m.dominant.map(|d| json!({
            "wavelength_nm": d.lambda_nm,
            "complementary": d.is_complementary,
            "excitation_purity": d.excitation_purity,
            "colorimetric_purity": d.colorimetric_purity,
        })),
        "light": light,
        "warnings": warnings,
    })
}

fn light_json(light: &LightFacts) -> Value {
    let rendering = light.rendering.as_ref();
    json!({
        "cct_kelvin": light.cct_kelvin,
        "duv": light.duv,
        "ra": rendering.map(|r| r.ra),
        "r": rendering.map(|r| r.r),
        "rf": rendering.map(|r| r.rf),
        "rg": rendering.map(|r| r.rg),
    })
}

const CSV_HEAD: &str = "name,X,Y,Z,x,y,L,a,b,R_linear,G_linear,B_linear,shown_scale,R_encoded,G_encoded,B_encoded,hex,\
    in_gamut,dominant_nm,complementary,excitation_purity,cct_kelvin,duv,ra,rf,rg";

/// A line of names, then one line a spectrum with every digit; what there is not is an empty cell.
pub fn csv(measured: &[Measured]) -> String {
    let lines = measured.iter().map(|one| {
        let m = &one.measurement;
        let mut cells = vec![quoted(&one.spectrum.name)];
        let mut push = |values: &[Option<f64>]| {
            cells.extend(values.iter().map(|value| value.map_or(String::new(), |v| v.to_string())));
        };
        push(&m.xyz.to_array().map(Some));
        push(&m.xy.map_or([None; 2], |xy| xy.map(Some)));
        push(&m.lab.to_array().map(Some));
        push(&m.linear.to_array().map(Some));
        push(&[Some(m.shown_scale)]);
        push(&m.encoded.to_array().map(Some));
        cells.extend([hex(m.rgb8), m.in_gamut.to_string()]);
        cells.push(m.dominant.map_or(String::new(), |d| d.lambda_nm.to_string()));
        cells.push(m.dominant.map_or(String::new(), |d| d.is_complementary.to_string()));
        cells.push(m.dominant.map_or(String::new(), |d| d.excitation_purity.to_string()));
        let light = m.light.as_ref();
        let rendering = light.and_then(|l| l.rendering.as_ref());
        let [ra, rf, rg] = [rendering.map(|r| r.ra), rendering.map(|r| r.rf), rendering.map(|r| r.rg)];
        let facts = [light.and_then(|l| l.cct_kelvin), light.and_then(|l| l.duv), ra, rf, rg];
        cells.extend(facts.map(|fact| fact.map_or(String::new(), |v| v.to_string())));
        cells.join(",") + "\n"
    });
    format!("{CSV_HEAD}\n{}", lines.collect::<String>())
}

/// A cell of a CSV, in quotes where it has to be.
fn quoted(text: &str) -> String {
    match text.contains([',', '"', ';', '#']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    }
}

/// The drawing.
pub fn plot<'a>(title: &str, viewing: &'a Viewing, measured: &'a [Measured]) -> Plot<'a> {
    let curves = measured.iter().map(|one| Curve {
        name: &one.spectrum.name,
        table: &one.spectrum.table,
        color: one.measurement.srgb8,
        xy: one.measurement.xy.unwrap_or([f64::NAN; 2]),
        dominant_xy: one.measurement.dominant.filter(|_| measured.len() == 1).map(|d| d.boundary_xy),
    });
    let is_light = viewing.quantity == Quantity::Emission;
    let lamp = (!is_light).then(|| (viewing.lamp.name.as_str(), viewing.lamp.spectrum.tabulate()));
    let mut notes = vec![circumstances(viewing)];
    if let [one] = measured {
        notes[0] += &format!(" · {}", hex(one.measurement.rgb8));
        notes.push(plot_note(&one.measurement));
    }
    Plot {
        title: title.to_owned(),
        notes,
        value_label: match viewing.quantity {
            Quantity::Emission => "emission",
            Quantity::Reflectance => "reflectance",
            Quantity::Transmittance => "transmittance",
        },
        values_are_shares: !is_light,
        curves: curves.collect(),
        lamp,
        observer: viewing.observer,
        space: viewing.space,
        white: (&viewing.lamp.name, chromaticity(viewing.white_xyz)),
    }
}

fn plot_note(m: &Measurement) -> String {
    let [x, y, z] = m.xyz.to_array().map(|v| significant(v, 4));
    let mut note = format!("XYZ {x}, {y}, {z}");
    if let Some([x, y]) = m.xy {
        note += &format!(" · xy {x:.4}, {y:.4}");
    }
    let [l, a, b] = m.lab.to_array();
    note += &format!(" · Lab {l:.2}, {a:.2}, {b:.2}");
    if let Some(d) = &m.dominant {
        note += &format!(" · {} {:.1} nm", if d.is_complementary { "complementary" } else { "dominant" }, d.lambda_nm);
    }
    if let Some(kelvin) = m.light.as_ref().and_then(|light| light.cct_kelvin) {
        note += &format!(" · {kelvin:.0} K");
    }
    note
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_digits_that_were_asked_for() {
        let six = |value| significant(value, 6);
        assert_eq!(
            [0.0, 1.0, -0.5, 123.456_789, 0.000_1].map(six),
            ["0", "1.00000", "-0.500000", "123.457", "0.000100"]
        );
        assert_eq!([1e-5, 2.5e8, 1_234_567.8].map(six), ["1.00000e-5", "2.50000e8", "1234568"]);
        assert_eq!(triple([0.5, -12.0, 1e-9]), "0.500000    -12.0000  1.00000e-9");
        assert_eq!(triple([1.0, -1e-17, 0.0]), "1.00000           0           0");
    }

    #[test]
    fn cells_are_quoted_where_they_have_to_be() {
        assert_eq!(["red", "a,b", "say \"x\""].map(quoted), ["red", "\"a,b\"", "\"say \"\"x\"\"\""]);
    }
}
