//! Tables of data/ as the library holds them.

use super::{Answer, Function, read};
use abbe::color::{Observer, illuminant, measured};
use abbe::spectrum::Spectrum;
use serde_json::{Value, json};

/// By name.
pub const FUNCTIONS: &[(&str, Function)] = &[
    ("names", names),
    ("observer_table", observer_table),
    ("illuminant_table", illuminant_table),
    ("lamp_table", lamp_table),
    ("patch_table", patch_table),
];

/// Everything of a kind that has a name.
fn names(argument: &Value) -> Answer {
    let kind: String = read(argument)?;
    let names: Vec<&str> = match kind.as_str() {
        "observers" => Observer::names().collect(),
        "illuminants" => illuminant::names().collect(),
        "lamps" => measured::lamps().collect(),
        "checkers" => measured::checkers().collect(),
        checker => measured::checker(checker)?.into_iter().map(|(patch, _)| patch).collect(),
    };
    Ok(json!(names))
}

/// Rows of wavelength, x̄, ȳ, z̄ at the published wavelengths.
fn observer_table(argument: &Value) -> Answer {
    let observer = Observer::by_name(&read::<String>(argument)?)?;
    let from_nm = observer.published_range_nm().0;
    let lambdas = observer.curves()[0].lambdas_nm().iter().filter(|lambda| **lambda >= from_nm);
    let row = |&lambda: &f64| [vec![lambda], observer.eval(lambda).to_array().to_vec()].concat();
    Ok(json!(lambdas.map(row).collect::<Vec<_>>()))
}

fn illuminant_table(argument: &Value) -> Answer {
    let table = illuminant::relative_power(&read::<String>(argument)?)?;
    Ok(json!(table.knots().collect::<Vec<_>>()))
}

fn lamp_table(argument: &Value) -> Answer {
    knots(&measured::lamp(&read::<String>(argument)?)?)
}

/// Of a chart and a patch.
fn patch_table(argument: &Value) -> Answer {
    let (checker, patch): (String, String) = read(argument)?;
    let patches = measured::checker(&checker)?;
    let (_, spectrum) = patches.iter().find(|(name, _)| *name == patch).ok_or("no such patch")?;
    knots(spectrum)
}

fn knots(spectrum: &Spectrum) -> Answer {
    match spectrum {
        Spectrum::PiecewiseLinear(table) => Ok(json!(table.knots().collect::<Vec<_>>())),
        _ => Err("not a table".into()),
    }
}
