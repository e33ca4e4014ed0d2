use super::*;
use proptest::prelude::*;

const WATER: &str = "# comment\nREFERENCES: |\n    A. Author.\n    <i>J. Opt.</i><br><b>1</b>, 2 < 3\nDATA:\n  - type: formula 2\n    wavelength_range: 0.4 0.8\n    coefficients: 0 0.5 0.01\n  - type: tabulated k\n    data: |\n        0.4 1e-7\n        0.8 2e-7\nPROPERTIES:\n    nd: 1.2\n";

#[test]
fn a_formula_with_a_table_of_k() {
    let constants = parse(WATER).unwrap();
    assert_eq!(constants.n.range_nm(), Some([400.0, 800.0]));
    assert_eq!(constants.n.eval(500.0), f64::sqrt(1.0 + 0.5 * 0.25 / (0.25 - 0.01)));
    assert!((constants.k.unwrap().eval(600.0) - 1.5e-7).abs() < 1e-20);
    assert_eq!(constants.references, "A. Author. J. Opt. 1, 2 < 3");
    assert_eq!(constants.comments, "");
}

#[test]
fn tables_in_any_order_with_repeated_wavelengths() {
    let text = "DATA:\n  - type: tabulated nk\n    data: |\n        0.8 1.4 3\n        0.5 1.5 2\n\n        0.5 1.7 4\n        0.4 1.6 1\n";
    let constants = parse(text).unwrap();
    let k = constants.k.unwrap();
    assert_eq!(k.wavelengths_nm(), [400.0, 500.0, 800.0]);
    assert_eq!(k.values(), [1.0, 3.0, 3.0]);
    assert!((constants.n.eval(500.0) - 1.6).abs() < 1e-15);
    // A table of one row, written as a plain scalar, and the older name of the range.
    let one = parse("DATA:\n  - type: tabulated n\n    data: 0.5 1.5\n").unwrap();
    assert_eq!((one.n.eval(300.0), one.k), (1.5, None));
    assert!(parse("DATA:\n - {type: formula 5, range: 0.8 0.4, coefficients: 1.5}\n").is_ok());
}

/// The kind and the beginning of the text of the error for each way in which a file can be wrong.
#[test]
fn malformed_files_are_errors_with_their_place() {
    use ErrorKind::*;
    let block = |lines: &[&str]| format!("DATA:\n  - {}\n", lines.join("\n    "));
    let formula = |range: &str, coefficients: &str| {
        block(&["type: formula 1", &format!("wavelength_range: {range}"), &format!("coefficients: {coefficients}")])
    };
    let table = |rows: &str| block(&["type: tabulated n", "data: |", &format!("    {rows}")]);
    let cases = [
        (String::new(), Missing, ""),
        ("REFERENCES: x\n".into(), Missing, "expected the key DATA"),
        ("DATA: [\n".into(), Syntax, "line "),
        ("- 1\n- 2\n".into(), Syntax, "line 1: "),
        ("just text".into(), Syntax, "line 1: "),
        ("DATA: 5\n".into(), Syntax, "line 1: "),
        ("DATA: []\n".into(), Missing, "DATA: expected a block with the index n"),
        ("DATA:\n  - 5\n".into(), Syntax, "line 2: "),
        ("DATA:\n  - type: [1, 2]\n".into(), Syntax, "line 2: "),
        ("a: 1\na: 2\nDATA: []\nDATA: []\n".into(), Syntax, "line "),
        (block(&["data: 0.5 1.5"]), Missing, "line 2: DATA[0]: expected the key type"),
        (block(&["type: formula 1", "coefficients: 0"]), Missing, "line 2: DATA[0]: expected the key wavelength_range"),
        (block(&["type: formula 1", "range: 0.4 0.8"]), Missing, "line 2: DATA[0]: expected the key coefficients"),
        (block(&["type: tabulated n"]), Missing, "line 2: DATA[0]: expected the key data"),
        (
            block(&["type: formula 10", "range: 0.4 0.8", "coefficients: 0"]),
            Unsupported,
            "line 4: DATA[0].coefficients: ",
        ),
        (block(&["type: formula x"]), Unsupported, "line 2: DATA[0].type: \"formula x\": expected"),
        (block(&["type: tabulated 3"]), Unsupported, "line 2: DATA[0].type: \"tabulated 3\""),
        (block(&["type: magic"]), Unsupported, "line 2: DATA[0].type: \"magic\""),
        (formula("0.4 0.8", "0 1"), Missing, "line 4: DATA[0].coefficients: formula 1: expected an odd number"),
        (formula("0.4 0.8", "0 1 x"), FileFormat, "line 4: DATA[0].coefficients: found \"x\", expected a number"),
        (formula("0.4 0.8", "0 1 inf"), NotFinite, "line 4: DATA[0].coefficients: "),
        (formula("0.4", "0"), FileFormat, "line 3: DATA[0].wavelength_range: expected two wavelengths"),
        (formula("0.4 0.4", "0"), OutOfRange, "line 3: DATA[0].wavelength_range: "),
        (formula("-0.4 0.8", "0"), OutOfRange, "line 3: DATA[0].wavelength_range: "),
        (table("0.5"), FileFormat, "line 4: DATA[0].data, row 1: found 1 numbers, expected 2"),
        (table("0.5 1.5\n        0.6 1.4 1.3"), FileFormat, "line 5: DATA[0].data, row 2: found 3 numbers"),
        (table("0.5 nan"), NotFinite, "line 4: DATA[0].data, row 1: "),
        (table("0.5 1,5"), FileFormat, "line 4: DATA[0].data, row 1: found \"1,5\""),
        (table("0 1.5"), OutOfRange, "line 4: DATA[0].data, row 1: "),
        (table(""), Missing, "line 3: DATA[0].data: "),
        (
            format!("{}  - type: tabulated n\n    data: 0.5 1.5\n", formula("0.4 0.8", "0")),
            Duplicate,
            "line 5: DATA[1]: ",
        ),
        (block(&["type: tabulated k", "data: 0.5 1.5"]), Missing, "DATA: expected a block with the index n"),
        ("[".repeat(100_000), Syntax, ""),
    ];
    for (text, kind, beginning) in cases {
        let shown: String = text.chars().take(200).collect();
        let error = parse(&text).expect_err(&shown);
        let message = error.to_string();
        assert!(error.kind == kind || error.kind == LimitExceeded, "{shown}: {:?}: {message}", error.kind);
        assert!(message.starts_with(beginning), "{shown}: {message}");
        assert!(!message.contains('\n') && message.len() < 400, "{shown}: {message}");
    }
}

#[test]
fn alias_bombs_are_refused() {
    let mut text = String::from("a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n");
    for i in 1..12 {
        let alias = format!("*a{}", i - 1);
        text += &format!("a{i}: &a{i} [{}]\n", [alias.as_str(); 10].join(", "));
    }
    assert!(parse(&(text + "DATA: *a11\n")).is_err());
}

#[test]
fn files_that_cannot_be_read_are_errors_that_name_them() {
    let error = read(Path::new("no/such/file.yml")).unwrap_err();
    assert_eq!(error.to_string(), "no/such/file.yml: no such file");
    let folder = std::env::temp_dir().join(format!("abbe-rii-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let file = folder.join("x.yml");
    std::fs::write(&file, b"DATA: \xff").unwrap();
    let binary = read(&file).unwrap_err();
    std::fs::write(&file, WATER).unwrap();
    let good = read(&file);
    // A sparse file takes no space.
    File::create(&file).unwrap().set_len(MAX_FILE_BYTES + 1).unwrap();
    let large = read(&file).unwrap_err();
    std::fs::remove_dir_all(&folder).unwrap();
    assert_eq!((binary.kind, binary.file), (ErrorKind::Syntax, Some(file)));
    assert!(good.is_ok());
    assert_eq!(large.kind, ErrorKind::LimitExceeded);
}

proptest! {
    #[test]
    fn random_bytes_do_not_panic(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let _ = parse(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn damaged_files_do_not_panic(at in 0..WATER.len(), bytes in "\\PC{0,6}", cut in 0..40_usize) {
        let end = (at + cut).min(WATER.len());
        let _ = parse(&format!("{}{bytes}{}", &WATER[..at], &WATER[end..]));
    }

    #[test]
    fn random_words_of_the_format_do_not_panic(
        words in prop::collection::vec(
            prop::sample::select(vec![
                "DATA:", "\n", "\n  - ", "\n    ", "type:", "formula", "tabulated", "nk", "1", "9", "0.5", "-1e308", "|", "data:",
                "coefficients:", "range:", "&a", "*a", "<<:", "[", "]", "{", "}", "'", "\"", "---", "!!binary", "?", "nan", "\t",
            ]),
            0..40,
        )
    ) {
        let _ = parse(&words.join(" "));
    }
}
