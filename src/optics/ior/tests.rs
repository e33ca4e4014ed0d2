use super::*;
use proptest::prelude::*;

const BK7_B: [f64; 3] = [1.03961212, 0.231792344, 1.01046945];
const BK7_C: [f64; 3] = [0.00600069867, 0.0200179144, 103.560653];

fn checked(
    ior: Result<IndexOfRefraction>,
    extrapolation: Extrapolation,
) -> Result<(IndexOfRefraction, Option<String>)> {
    ior?.checked("glass \"X\"", extrapolation)
}

fn bk7(from_nm: f64, to_nm: f64) -> Result<IndexOfRefraction> {
    let coefficients = [0.0, BK7_B[0], BK7_C[0], BK7_B[1], BK7_C[1], BK7_B[2], BK7_C[2]];
    IndexOfRefraction::formula(Dispersion::from_coefficients(2, &coefficients)?, [from_nm, to_nm])
}

#[test]
fn sellmeier_of_bk7_gives_the_data_sheet() {
    let ior = IndexOfRefraction::sellmeier(&BK7_B, &BK7_C).unwrap();
    // SCHOTT data sheet of N-BK7.
    let data_sheet = [("i", 1.53627), ("h", 1.53024), ("g", 1.52668), ("F", 1.52238), ("e", 1.51872), ("d", 1.51680)];
    for (line, n) in data_sheet.into_iter().chain([("C", 1.51432), ("r", 1.51289), ("s", 1.50980), ("t", 1.50731)]) {
        let (_, lambda_nm) = FRAUNHOFER_LINES.into_iter().find(|(name, _)| *name == line).unwrap();
        assert!((ior.eval(lambda_nm) - n).abs() < 5.5e-6, "{line}: {} is not {n}", ior.eval(lambda_nm));
    }
    assert!((ior.abbe_number() - 64.17).abs() < 0.005);
    assert!((ior.partial_dispersion_gf() - 0.5349).abs() < 5e-5);
    assert_eq!(ior.range_nm(), None);
}

#[test]
fn cauchy_is_even_negative_powers_of_micrometres() {
    let ior = IndexOfRefraction::cauchy_um(&[1.5, 0.004, 0.0002]).unwrap();
    assert!((ior.eval(500.0) - 1.5192).abs() < 1e-15);
    assert!((ior.eval(1000.0) - 1.5042).abs() < 1e-15);
}

#[test]
fn a_bubble_may_be_below_one_but_not_below_zero() {
    for n in [1e-3, 0.75, 1.0, 100.0] {
        let (ior, warning) = checked(IndexOfRefraction::constant(n), Extrapolation::Continue).unwrap();
        assert_eq!((ior.eval(500.0), warning, ior.is_dispersive()), (n, None, false));
    }
    for n in [0.0, -1.5, 100.1] {
        assert_eq!(IndexOfRefraction::constant(n).unwrap_err().kind, ErrorKind::OutOfRange);
    }
    assert_eq!(IndexOfRefraction::constant(f64::NAN).unwrap_err().kind, ErrorKind::NotFinite);
}

#[test]
fn dispersive_is_a_fact_of_the_data() {
    let flat_formulas = [
        IndexOfRefraction::cauchy_um(&[1.5]),
        IndexOfRefraction::cauchy_um(&[1.5, 0.0, 0.0]),
        IndexOfRefraction::sellmeier(&[1.25], &[0.0]),
        IndexOfRefraction::from_abbe(1.0, 30.0),
        IndexOfRefraction::tabulated(vec![360.0, 500.0, 830.0], vec![1.5; 3]),
        // Different only outside the rendering range.
        IndexOfRefraction::tabulated(vec![300.0, 350.0, 830.0, 900.0], vec![1.6, 1.5, 1.5, 1.4]),
    ];
    for ior in flat_formulas {
        let ior = ior.unwrap();
        assert!(!ior.is_dispersive(), "{ior:?}");
        assert_eq!(ior.abbe_number(), f64::INFINITY);
    }
    // A spike between two whole nanometres.
    let spike = IndexOfRefraction::tabulated(vec![360.0, 500.2, 500.4, 500.6, 830.0], vec![1.5, 1.5, 1.6, 1.5, 1.5]);
    assert!(spike.unwrap().is_dispersive());
    assert!(IndexOfRefraction::from_abbe(1.5, 1e6).unwrap().is_dispersive());
}

#[test]
fn formulas_are_continued_by_100_nm_with_a_warning_that_names_the_glass() {
    let (ior, warning) = checked(bk7(300.0, 2500.0), Extrapolation::Continue).unwrap();
    assert_eq!(warning, None);
    assert_eq!(ior.range_nm(), Some([300.0, 2500.0]));

    let (ior, warning) = checked(bk7(400.0, 730.0), Extrapolation::Continue).unwrap();
    assert_eq!(warning.unwrap(), "glass \"X\": the formula is valid over 400–730 nm, continued to 360–830 nm");
    assert_eq!(ior.eval(830.0), bk7(300.0, 2500.0).unwrap().eval(830.0));

    for (from_nm, to_nm) in [(300.0, 729.9), (460.1, 900.0)] {
        let error = checked(bk7(from_nm, to_nm), Extrapolation::Continue).unwrap_err();
        assert_eq!(error.kind, ErrorKind::OutOfRange);
        assert!(error.message.starts_with("glass \"X\": the formula is valid over"), "{error}");
        assert!(error.message.contains("\"extrapolate\": \"hold\""), "{error}");
    }
}

#[test]
fn held_formulas_keep_their_end_values() {
    let (ior, warning) = checked(bk7(500.0, 600.0), Extrapolation::Hold).unwrap();
    let free = bk7(300.0, 2500.0).unwrap();
    assert_eq!(warning, None);
    assert_eq!(ior.eval(360.0), free.eval(500.0));
    assert_eq!(ior.eval(550.0), free.eval(550.0));
    assert_eq!(ior.eval(830.0), free.eval(600.0));
}

#[test]
fn tables_are_not_continued() {
    let table = || IndexOfRefraction::tabulated(vec![400.0, 700.0], vec![1.53, 1.51]);
    let error = checked(table(), Extrapolation::Continue).unwrap_err();
    assert_eq!(error.kind, ErrorKind::OutOfRange);
    assert!(error.message.starts_with("glass \"X\": the table covers 400–700 nm, but 360–830 nm is needed"), "{error}");
    let (held, warning) = checked(table(), Extrapolation::Hold).unwrap();
    assert_eq!((held.eval(360.0), held.eval(830.0), warning), (1.53, 1.51, None));
    let full = IndexOfRefraction::tabulated(vec![0.36 * 1e3, 0.83 * 1e3], vec![1.53, 1.51]);
    assert_eq!(checked(full, Extrapolation::Continue).unwrap().1, None);
}

#[test]
fn unphysical_indices_are_errors() {
    let kind = |ior| checked(ior, Extrapolation::Continue).unwrap_err().kind;
    // n² < 0 in the blue.
    assert_eq!(kind(IndexOfRefraction::sellmeier(&[-1.0], &[0.1])), ErrorKind::NotFinite);
    // A resonance so weak that no whole nanometre shows it.
    assert_eq!(kind(IndexOfRefraction::sellmeier(&[1.2, 1e-15], &[0.01, 0.5001 * 0.5001])), ErrorKind::NotFinite);
    assert_eq!(kind(IndexOfRefraction::cauchy_um(&[-0.5])), ErrorKind::OutOfRange);
    assert_eq!(kind(IndexOfRefraction::cauchy_um(&[1000.0])), ErrorKind::OutOfRange);
    assert_eq!(kind(IndexOfRefraction::cauchy_um(&[1.5, f64::NAN])), ErrorKind::NotFinite);
    assert_eq!(kind(IndexOfRefraction::cauchy_um(&[])), ErrorKind::Missing);
    assert_eq!(kind(IndexOfRefraction::sellmeier(&[1.0], &[])), ErrorKind::Missing);
    // One row of the table between two whole nanometres.
    let row = IndexOfRefraction::tabulated(vec![300.0, 500.2, 500.4, 500.6, 900.0], vec![1.5, 1.5, 0.0, 1.5, 1.5]);
    assert_eq!(kind(row), ErrorKind::OutOfRange);
    // Below 1 is right inside the range of validity and wrong outside.
    let below_one = |range_nm| {
        let gas = Dispersion::from_coefficients(5, &[1.2, -0.05, -2.0])?;
        IndexOfRefraction::formula(gas, range_nm)
    };
    assert!(checked(below_one([360.0, 830.0]), Extrapolation::Continue).is_ok());
    assert_eq!(kind(below_one([460.0, 830.0])), ErrorKind::OutOfRange);
    for range_nm in [[500.0, 500.0], [600.0, 500.0], [f64::NAN, 500.0], [-1.0, 500.0]] {
        assert_eq!(bk7(range_nm[0], range_nm[1]).unwrap_err().kind, ErrorKind::OutOfRange);
    }
    for (n_d, v_d) in [(1.5, 0.0), (1.5, -3.0), (0.0, 50.0)] {
        assert_eq!(IndexOfRefraction::from_abbe(n_d, v_d).unwrap_err().kind, ErrorKind::OutOfRange);
    }
    assert_eq!(IndexOfRefraction::from_abbe(1.5, f64::INFINITY).unwrap_err().kind, ErrorKind::NotFinite);
}

#[test]
fn single_wavelengths_follow_the_same_rules() {
    let ior = bk7(400.0, 700.0).unwrap();
    assert_eq!(ior.eval_checked(550.0, "X").unwrap(), (ior.eval(550.0), None));
    let (_, warning) = ior.eval_checked(750.0, "X").unwrap();
    assert_eq!(warning.unwrap(), "X: the formula is valid over 400–700 nm, continued to 400–750 nm");
    for lambda_nm in [299.0, 801.0, 0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(ior.eval_checked(lambda_nm, "X").unwrap_err().kind, ErrorKind::OutOfRange, "{lambda_nm}");
    }
}

proptest! {
    #[test]
    fn abbe_number_round_trip(n_d in 1.2_f64..2.5, v_d in 15.0_f64..100.0) {
        let ior = IndexOfRefraction::from_abbe(n_d, v_d).unwrap();
        prop_assert!((ior.n_d() - n_d).abs() <= 4.0 * f64::EPSILON * n_d);
        // n_F − n_C loses about two digits to cancellation.
        prop_assert!((ior.abbe_number() / v_d - 1.0).abs() < 1e-12);
    }

    #[test]
    fn checked_indices_are_finite_and_positive_everywhere(
        b in prop::collection::vec(-3.0_f64..3.0, 1..4), c in prop::collection::vec(-1.0_f64..1.0, 4),
    ) {
        let ior = IndexOfRefraction::sellmeier(&b, &c[..b.len()]).unwrap();
        if let Ok((ior, _)) = ior.checked("X", Extrapolation::Continue) {
            for lambda_nm in 360..=830 {
                let n = ior.eval(f64::from(lambda_nm));
                prop_assert!(n > 0.0 && n <= MAX_INDEX);
            }
        }
    }
}
