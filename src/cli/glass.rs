//! `abbe glass`: the catalogue of glasses, or one of them at chosen wavelengths.

use serde_json::{Value, json};

use crate::io::catalogue::{self, GlassEntry};
use crate::io::refractive_index_info::OpticalConstants;
use crate::optics::ior::{FRAUNHOFER_LINES, IndexOfRefraction};
use crate::{Error, ErrorKind, Result};

/// Arguments of `abbe glass`.
#[derive(Debug, Clone, Default, PartialEq, clap::Args)]
pub struct GlassArgs {
    /// A glass, crystal, liquid or plastic of the catalogue; all are listed without one
    pub name: Option<String>,
    /// Wavelength in nanometres to print the index at; may be repeated. Default: the Fraunhofer lines
    #[arg(long, value_name = "NM", allow_negative_numbers = true)]
    pub at: Vec<f64>,
    /// Print one JSON value instead of text
    #[arg(long)]
    pub json: bool,
}

/// Prints the catalogue or a glass to stdout, and warnings to stderr.
///
/// # Errors
/// `UnknownName` for a glass that is not in the catalogue, `OutOfRange` for wavelengths that its data don't reach,
/// `Usage` for wavelengths without a glass, `Io`.
pub fn run(args: &GlassArgs) -> Result<()> {
    let Output { text, warnings } = output(args)?;
    for warning in warnings {
        eprintln!("warning: {warning}");
    }
    super::write_data(&mut std::io::stdout().lock(), text.as_bytes())
}

/// What the command prints.
struct Output {
    text: String,
    warnings: Vec<String>,
}

fn output(args: &GlassArgs) -> Result<Output> {
    let Some(name) = &args.name else {
        if !args.at.is_empty() {
            let message = "--at needs the name of a glass, as in `abbe glass N-BK7 --at 550`";
            return Err(Error::new(ErrorKind::Usage, message));
        }
        let entries = catalogue::glasses()?;
        let text = if args.json { json_line(&catalogue_json(entries)) } else { catalogue_text(entries) };
        return Ok(Output { text, warnings: Vec::new() });
    };
    let entry = catalogue::glass(name)?;
    let constants = entry.constants()?;
    let (samples, warnings) = samples(entry, &constants.n, &args.at)?;
    let fit = AbbeFit::of(&constants.n)?;
    let text = if args.json {
        json_line(&glass_json(entry, &constants, &samples, &fit))
    } else {
        glass_text(entry, &constants, &samples, &fit)
    };
    Ok(Output { text, warnings })
}

/// The index at one wavelength.
struct Sample {
    line: Option<&'static str>,
    lambda_nm: f64,
    n: f64,
    continued: bool,
}

/// The index at the wanted wavelengths with a warning for each that lies outside the data, or at those Fraunhofer lines
/// that the data reach.
fn samples(entry: &GlassEntry, n: &IndexOfRefraction, at_nm: &[f64]) -> Result<(Vec<Sample>, Vec<String>)> {
    let subject = format!("glass \"{}\"", entry.name);
    if at_nm.is_empty() {
        let lines = FRAUNHOFER_LINES.into_iter().filter_map(|(line, lambda_nm)| {
            let (n, warning) = n.eval_checked(lambda_nm, &subject).ok()?;
            Some(Sample { line: Some(line), lambda_nm, n, continued: warning.is_some() })
        });
        return Ok((lines.collect(), Vec::new()));
    }
    let (mut samples, mut warnings) = (Vec::new(), Vec::new());
    for &lambda_nm in at_nm {
        let (n, warning) = n.eval_checked(lambda_nm, &subject).map_err(|e| e.at("--at"))?;
        samples.push(Sample { line: None, lambda_nm, n, continued: warning.is_some() });
        warnings.extend(warning);
    }
    Ok((samples, warnings))
}

/// How well the two-parameter formula through n_d and V_d stands in for the real one over 400–700 nm.
struct AbbeFit {
    largest_error: f64,
    at_nm: f64,
}

impl AbbeFit {
    fn of(n: &IndexOfRefraction) -> Result<Self> {
        let fit = IndexOfRefraction::from_abbe(n.n_d(), n.abbe_number())?;
        let worst = (400..=700)
            .map(|nm| (fit.eval(f64::from(nm)) - n.eval(f64::from(nm)), f64::from(nm)))
            .max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
        let (largest_error, at_nm) = worst.unwrap_or_default();
        Ok(Self { largest_error, at_nm })
    }
}

fn catalogue_text(entries: &[GlassEntry]) -> String {
    let rows = entries.iter().map(|entry| {
        let [from, to] = entry.range_nm;
        [
            entry.name.to_owned(),
            format!("{:.5}", entry.n_d),
            format!("{:.2}", entry.v_d),
            format!("{from:.0}–{to:.0}"),
            format!("{}; {}", entry.description, entry.source),
        ]
    });
    let head = ["name", "n_d", "V_d", "range (nm)", "source"].map(str::to_owned);
    let rows: Vec<[String; 5]> = std::iter::once(head).chain(rows).collect();
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or_default();
    let [name, n_d, v_d, range] = [0, 1, 2, 3].map(width);
    let line = |[a, b, c, d, e]: &[String; 5]| format!("{a:name$}  {b:>n_d$}  {c:>v_d$}  {d:>range$}  {e}\n");
    rows.iter().map(line).collect()
}

fn glass_text(entry: &GlassEntry, constants: &OpticalConstants, samples: &[Sample], fit: &AbbeFit) -> String {
    let n = &constants.n;
    let [from, to] = entry.range_nm;
    let mut text = format!("{}: {}\n", entry.name, entry.description);
    if !entry.aliases.is_empty() {
        text += &format!("also     {}\n", entry.aliases.join(", "));
    }
    text += &format!("n_d      {:.6}\n", n.n_d());
    text += &format!("V_d      {:.3}\n", n.abbe_number());
    text += &format!("P_gF     {:.4}\n", n.partial_dispersion_gf());
    text += &format!("range    {from}–{to} nm ({})\n", n.kind_name());
    text += &format!("source   {} (refractiveindex.info {})\n", constants.references, entry.page);
    if !constants.comments.is_empty() {
        text += &format!("remarks  {}\n", constants.comments);
    }
    text += &format!(
        "The formula through n_d and V_d alone is off by {:+.1e} at most over 400–700 nm (at {} nm).\n",
        fit.largest_error, fit.at_nm
    );
    for sample in samples {
        let line = sample.line.unwrap_or_default();
        let remark = if sample.continued { "  (outside the range, continued)" } else { "" };
        text += &format!("{line:<2} {:>9.4} nm  {:.6}{remark}\n", sample.lambda_nm, sample.n);
    }
    text
}

fn entry_json(entry: &GlassEntry) -> Value {
    json!({
        "name": entry.name,
        "aliases": entry.aliases,
        "description": entry.description,
        "n_d": entry.n_d,
        "v_d": entry.v_d,
        "range_nm": entry.range_nm,
        "source": entry.source,
        "page": entry.page,
    })
}

fn catalogue_json(entries: &[GlassEntry]) -> Value {
    entries.iter().map(entry_json).collect()
}

fn glass_json(entry: &GlassEntry, constants: &OpticalConstants, samples: &[Sample], fit: &AbbeFit) -> Value {
    let mut value = entry_json(entry);
    value["n_d"] = json!(constants.n.n_d());
    value["v_d"] = json!(constants.n.abbe_number());
    value["p_gf"] = json!(constants.n.partial_dispersion_gf());
    value["kind"] = json!(constants.n.kind_name());
    value["references"] = json!(constants.references);
    value["comments"] = json!(constants.comments);
    value["abbe_fit"] = json!({ "largest_error": fit.largest_error, "at_nm": fit.at_nm, "from_nm": 400, "to_nm": 700 });
    value["indices"] = samples
        .iter()
        .map(|s| json!({ "line": s.line, "wavelength_nm": s.lambda_nm, "n": s.n, "continued": s.continued }))
        .collect();
    value
}

fn json_line(value: &Value) -> String {
    format!("{value}\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn args(name: Option<&str>, at: &[f64], json: bool) -> GlassArgs {
        GlassArgs { name: name.map(str::to_owned), at: at.to_vec(), json }
    }

    #[test]
    fn the_table_has_a_line_for_every_glass() {
        let text = output(&args(None, &[], false)).unwrap().text;
        assert_eq!(text.lines().count(), catalogue::glasses().unwrap().len() + 1);
        let bk7 = text.lines().find(|line| line.starts_with("N-BK7 ")).unwrap();
        let cells: Vec<_> = bk7.split_whitespace().take(4).collect();
        assert_eq!(cells, ["N-BK7", "1.51680", "64.17", "300–2500"]);
        let json: Value = serde_json::from_str(&output(&args(None, &[], true)).unwrap().text).unwrap();
        assert_eq!(json.as_array().unwrap().len(), catalogue::glasses().unwrap().len());
        assert_eq!(json[0]["name"], "N-BK7");
    }

    #[test]
    fn a_glass_is_shown_at_the_fraunhofer_lines() {
        let text = output(&args(Some("bk7"), &[], false)).unwrap().text;
        assert!(text.starts_with("N-BK7: optical glass\nalso     BK7\nn_d      1.516800\nV_d      64.167\n"), "{text}");
        assert!(text.contains("\nd   587.5618 nm  1.516800\n"), "{text}");
        assert!(text.contains("\nt  1013.9800 nm  1.507"), "{text}");
        let diamond = output(&args(Some("diamond"), &[], false)).unwrap().text;
        assert!(diamond.contains("s   852.1100 nm  2.397") && diamond.contains("continued"), "{diamond}");
        assert!(!diamond.contains("1013.98"), "{diamond}");
    }

    #[test]
    fn json_keeps_every_bit_of_the_index() {
        let out = output(&args(Some("diamond"), &[500.0, 800.0], true)).unwrap();
        let json: Value = serde_json::from_str(&out.text).unwrap();
        let n = catalogue::glass("diamond").unwrap().constants().unwrap().n;
        assert_eq!(json["indices"][0]["n"].as_f64(), Some(n.eval(500.0)));
        assert_eq!(json["indices"][1]["continued"], true);
        assert_eq!(out.warnings, ["glass \"diamond\": the formula is valid over 226–760 nm, continued to 226–800 nm"]);
    }

    #[test]
    fn the_abbe_fit_is_exact_in_the_middle_and_off_at_the_ends() {
        let n = catalogue::glass("N-SF11").unwrap().constants().unwrap().n;
        let fit = AbbeFit::of(&n).unwrap();
        assert_eq!(fit.at_nm, 400.0);
        assert!(fit.largest_error < -5e-3 && fit.largest_error > -1e-2, "{}", fit.largest_error);
        let own = IndexOfRefraction::from_abbe(1.5, 50.0).unwrap();
        assert!(AbbeFit::of(&own).unwrap().largest_error.abs() < 1e-14);
    }

    #[test]
    fn errors_have_their_kinds() {
        let error = |name, at: &[f64]| output(&args(name, at, false)).map(|out| out.text).unwrap_err();
        assert_eq!(crate::cli::exit_code(error(Some("N-SF12"), &[]).kind), 3);
        assert_eq!(error(Some("N-SF12"), &[]).kind, ErrorKind::UnknownName);
        assert_eq!(error(None, &[500.0]).kind, ErrorKind::Usage);
        for lambda_nm in [0.0, -1.0, f64::NAN, 50.0, 3000.0] {
            let error = error(Some("N-BK7"), &[lambda_nm]);
            assert_eq!((error.kind, error.place.as_str()), (ErrorKind::OutOfRange, "--at"), "{lambda_nm}");
        }
        assert_eq!(error(Some("ice"), &[30.0]).kind, ErrorKind::OutOfRange);
    }

    #[test]
    fn the_command_line_is_as_documented() {
        #[derive(clap::Parser)]
        struct Cli {
            #[command(flatten)]
            glass: GlassArgs,
        }
        let parsed = <Cli as clap::Parser>::try_parse_from(["x", "N-BK7", "--at", "500", "--at", "600.5", "--json"]);
        assert_eq!(parsed.map(|cli| cli.glass).unwrap(), args(Some("N-BK7"), &[500.0, 600.5], true));
    }
}
