use super::*;
use crate::optics::ior::Extrapolation;

/// n_d and V_d of SCHOTT's data sheets.
const DATA_SHEETS: [(&str, f64, f64); 20] = [
    ("N-BK7", 1.51680, 64.17),
    ("N-K5", 1.52249, 59.48),
    ("N-FK51A", 1.48656, 84.47),
    ("N-PK52A", 1.49700, 81.61),
    ("N-PSK53A", 1.61800, 63.39),
    ("N-BAK4", 1.56883, 55.98),
    ("N-SK16", 1.62041, 60.32),
    ("N-BAF10", 1.67003, 47.11),
    ("N-LAK8", 1.71300, 53.83),
    ("N-LASF9", 1.85025, 32.17),
    ("F2", 1.62004, 36.37),
    ("N-F2", 1.62005, 36.43),
    ("N-SF5", 1.67271, 32.25),
    ("N-SF6", 1.80518, 25.36),
    ("SF6", 1.80518, 25.43),
    ("SF10", 1.72825, 28.41),
    ("N-SF11", 1.78472, 25.68),
    ("SF11", 1.78472, 25.76),
    ("N-SF57", 1.84666, 23.78),
    ("N-SF66", 1.92286, 20.88),
];

#[test]
fn the_data_sheets_agree() {
    for (name, n_d, v_d) in DATA_SHEETS {
        let n = glass(name).unwrap().constants().unwrap().n;
        assert!((n.n_d() - n_d).abs() < 1e-5, "{name}: n_d {} is not {n_d}", n.n_d());
        assert!((n.abbe_number() - v_d).abs() < 0.01, "{name}: V_d {} is not {v_d}", n.abbe_number());
    }
}

#[test]
fn every_glass_agrees_with_the_index_file() {
    let entries = glasses().unwrap();
    assert!(entries.len() >= 60, "{} glasses", entries.len());
    for entry in entries {
        let constants = entry.constants().unwrap();
        let n = constants.n;
        // The index has seven and four decimals.
        assert!((n.n_d() - entry.n_d).abs() < 6e-8, "{}: n_d {}", entry.name, n.n_d());
        assert!((n.abbe_number() - entry.v_d).abs() < 6e-5, "{}: V_d {}", entry.name, n.abbe_number());
        let range_nm = n.range_nm().unwrap();
        for (found, stated) in range_nm.into_iter().zip(entry.range_nm) {
            assert!((found - stated).abs() < 0.006, "{}: {range_nm:?}", entry.name);
        }
        assert!(!constants.references.is_empty() && !constants.references.contains('<'), "{}", constants.references);
    }
}

#[test]
fn every_glass_covers_the_rendering_range_and_has_normal_dispersion() {
    let mut continued = Vec::new();
    for entry in glasses().unwrap() {
        let subject = format!("glass \"{}\"", entry.name);
        let n = entry.constants().unwrap().n;
        let (n, warning) = n.checked(&subject, Extrapolation::Continue).unwrap();
        if let Some(warning) = warning {
            assert!(warning.starts_with(&subject), "{warning}");
            continued.push(entry.name);
        }
        assert!(n.is_dispersive());
        for lambda_nm in 400..700 {
            let (here, next) = (n.eval(f64::from(lambda_nm)), n.eval(f64::from(lambda_nm + 1)));
            assert!(here > next && next > 1.0, "{}: n rises from {here} to {next} at {lambda_nm} nm", entry.name);
        }
    }
    assert!(continued.contains(&"diamond") && !continued.contains(&"N-BK7"), "{continued:?}");
}

#[test]
fn every_metal_covers_the_rendering_range_and_agrees_with_the_index_file() {
    assert!(metals().unwrap().len() >= 8);
    for entry in metals().unwrap() {
        let Metal { n, k } = entry.complex_index().unwrap();
        assert!(n.range_nm()[0] <= 360.0 && n.range_nm()[1] >= 830.0, "{}", entry.name);
        assert_eq!(n.wavelengths_nm(), k.wavelengths_nm());
        assert!((n.eval(550.0) - entry.n_550).abs() < 6e-7, "{}: n {}", entry.name, n.eval(550.0));
        assert!((k.eval(550.0) - entry.k_550).abs() < 6e-7, "{}: k {}", entry.name, k.eval(550.0));
        for lambda_nm in 360..=830 {
            let lambda_nm = f64::from(lambda_nm);
            assert!(n.eval(lambda_nm) > 0.0 && k.eval(lambda_nm) > 0.5, "{} at {lambda_nm} nm", entry.name);
        }
    }
    // Table II of Johnson and Christy 1972: gold at 2.38 eV.
    let gold = metal("gold").unwrap().complex_index().unwrap();
    assert_eq!((gold.n.eval(520.9), gold.k.eval(520.9)), (0.62, 2.081));
}

#[test]
fn names_and_aliases_resolve_whatever_their_case() {
    assert_eq!(glass("n-bk7").unwrap().name, "N-BK7");
    assert_eq!(glass("BK7").unwrap().name, "N-BK7");
    assert_eq!(glass("SiO2").unwrap().name, "fused-silica");
    assert_eq!(glass("Water").unwrap().name, "water");
    assert_eq!(metal("SILVER").unwrap().name, "Ag");
    let mut names: Vec<String> = Vec::new();
    for entry in glasses().unwrap() {
        names.extend(std::iter::once(&entry.name).chain(&entry.aliases).map(|name| name.to_lowercase()));
    }
    let count = names.len();
    names.sort();
    names.dedup();
    assert_eq!(names.len(), count, "a name stands for two glasses");
    assert_eq!(
        (glass_names().unwrap().count(), metal_names().unwrap().count()),
        (GLASS_FILES.len(), METAL_FILES.len())
    );
}

#[test]
fn unknown_names_get_the_nearest() {
    let error = glass("N-SF12").unwrap_err();
    assert_eq!(error.kind, ErrorKind::UnknownName);
    assert_eq!(error.to_string(), "unknown glass \"N-SF12\"; did you mean \"N-SF11\"?");
    assert_eq!(metal("goldd").unwrap_err().to_string(), "unknown metal \"goldd\"; did you mean \"gold\"?");
    assert_eq!(metal("").unwrap_err().nearest, None);
}

#[test]
fn bad_index_rows_are_errors_with_their_line() {
    let error = rows("# c\na,b\n1,2\n1,2,3\n", "x.csv", 2).unwrap_err();
    assert_eq!(error.to_string(), "x.csv: line 4: found 3 cells, expected 2");
    assert_eq!(cell_number("1,5", 7, "x.csv").unwrap_err().kind, ErrorKind::FileFormat);
    assert_eq!(embedded(METAL_FILES, "Xx").unwrap_err().kind, ErrorKind::FileNotFound);
}
