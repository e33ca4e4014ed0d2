//! `abbe spectrum`, `abbe upsample` and `abbe completions` as people and scripts meet them.

#[path = "common/command.rs"]
mod command;

use command::{Folder, Run};
use serde_json::{Value, json};

/// A file of the repository.
fn data(path: &str) -> String {
    format!("{}/data/{path}", env!("CARGO_MANIFEST_DIR"))
}

fn json_of(run: &Run) -> Value {
    serde_json::from_str(&run.succeeds().out).unwrap_or_else(|e| panic!("{e}: {run:?}"))
}

fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(parts) => parts.iter().flat_map(numbers).collect(),
        _ => vec![value.as_f64().unwrap_or_else(|| panic!("{value}; expected a number"))],
    }
}

/// Asserts numbers within 1e-9 of the largest of them.
fn assert_near(value: &Value, expected: &[f64], what: &str) {
    let found = numbers(value);
    assert_eq!(found.len(), expected.len(), "{what}: {value}");
    let scale = expected.iter().fold(1.0_f64, |m, x| m.max(x.abs()));
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() <= 1e-9 * scale, "{what}: {found:?}; expected {expected:?}");
    }
}

/// What a patch is expected to print. Computed with validation/subjects/cli.py: tables, Lab, RGB matrices (derived from
/// primaries), Bradford adaptation and encodings of colour-science 0.4.7; the products of piecewise linear functions
/// integrated exactly in NumPy.
struct Expected {
    patch: &'static str,
    light: &'static str,
    observer: &'static str,
    space: &'static str,
    xyz: [f64; 3],
    xy: [f64; 2],
    lab: [f64; 3],
    linear: [f64; 3],
    encoded: [f64; 3],
    hex: &'static str,
}

const PATCHES: [Expected; 3] = [
    Expected {
        patch: "dark-skin",
        light: "A",
        observer: "1931-2",
        space: "srgb",
        xyz: [0.1478812923620951, 0.10979816514010787, 0.019913726047711286],
        xy: [0.5327266702696409, 0.3955362438514812],
        lab: [39.5464553581234, 16.832373753276787, 19.274753441783876],
        linear: [0.19887966064558232, 0.08072105135832885, 0.049555984943518254],
        encoded: [0.48326785800688427, 0.31468369561243303, 0.24667721243284252],
        hex: "#7b503f",
    },
    Expected {
        patch: "cyan",
        light: "FL11",
        observer: "1964-10",
        space: "display-p3",
        xyz: [0.14022279922817688, 0.17592564772034805, 0.22567361065101518],
        xy: [0.25879861711317653, 0.3246926647832681],
        lab: [48.998156935835425, -23.62575627863317, -28.105428294770938],
        linear: [0.035897366390869316, 0.21469785782155876, 0.35114070470577885],
        encoded: [0.2087516617316768, 0.5007088833542028, 0.6271338737178922],
        hex: "#3580a0",
    },
    Expected {
        patch: "orange-yellow",
        light: "D65",
        observer: "2015-2",
        space: "prophoto-rgb",
        xyz: [0.4646477058015227, 0.42708511239746805, 0.08021703206953279],
        xy: [0.47805728420365834, 0.4394106468347888],
        lab: [71.35668265931709, 17.748512580118003, 66.42318368144433],
        linear: [0.5491836624509248, 0.3891349938451987, 0.07648637260860498],
        encoded: [0.7168011141244556, 0.5919403398296715, 0.23975569113856757],
        hex: "#b7973d",
    },
];

#[test]
fn patches_have_the_colours_of_the_reference() {
    let (folder, file) = (Folder::new(), data("reflectances/colorchecker_n_ohta.csv"));
    for e in &PATCHES {
        let run = folder.abbe(&[
            "spectrum",
            &file,
            "--illuminant",
            e.light,
            "--observer",
            e.observer,
            "--space",
            e.space,
            "--column",
            e.patch,
            "--json",
        ]);
        let answer = json_of(&run);
        let seen = [&answer["as"], &answer["observer"], &answer["space"], &answer["illuminant"]["name"]];
        assert_eq!(seen, [&json!("reflectance"), &json!(e.observer), &json!(e.space), &json!(e.light)]);
        let one = &answer["spectra"][0];
        assert_near(&one["xyz"], &e.xyz, e.patch);
        assert_near(&one["xy"], &e.xy, e.patch);
        assert_near(&one["lab"], &e.lab, e.patch);
        assert_near(&one["rgb_linear"], &e.linear, e.patch);
        assert_near(&one["rgb_encoded"], &e.encoded, e.patch);
        assert_eq!((&one["hex"], &one["in_gamut"]), (&json!(e.hex), &json!(true)), "{}", e.patch);
        assert_eq!((&one["light"], &one["shown_scale"]), (&Value::Null, &json!(1.0)));
    }
}

#[test]
fn lamps_have_the_colours_and_the_quality_of_the_reference() {
    // From the same script; the temperature is the root of the definition's derivative, Ra and R9 colour-science's CRI with
    // the samples "CIE 2024", Rf and Rg its TM-30-18.
    let folder = Folder::new();
    let run = folder.abbe(&["spectrum", &data("illuminants/fluorescent.csv"), "--column", "FL11", "--json"]);
    let answer = json_of(&run);
    assert_eq!(answer["as"], "emission");
    let (one, light) = (&answer["spectra"][0], &answer["spectra"][0]["light"]);
    assert_near(&one["xyz"], &[13.820737840099987, 13.69816255439724, 8.802385165276494], "XYZ");
    assert_near(&one["lab"], &[87.39376902895661, 8.958496076490963, 28.73534791883483], "Lab");
    assert_near(&one["rgb_linear"], &[19.344307280305216, 12.667429203059076, 7.2786095843945615], "linear");
    assert_near(&one["shown_scale"], &[0.05169479503761387], "scale");
    assert_near(&one["rgb_encoded"], &[1.0, 0.829386632144937, 0.6470620169934459], "encoded");
    assert_eq!(one["hex"], "#ffd3a5");
    assert_near(&light["cct_kelvin"], &[4000.8831381345944], "CCT");
    assert_near(&light["duv"], &[0.00016201305870967067], "Duv");
    assert_near(&json!([light["ra"], light["r"][8]]), &[82.8591468432796, 24.943393312604698], "CRI");
    assert_near(&json!([light["rf"], light["rg"]]), &[80.04041286325845, 101.05665456895305], "TM-30");
}

#[test]
fn a_colour_outside_the_gamut_is_told_and_moved_inside() {
    let folder = Folder::new();
    folder.write("line.csv", "nm,value\n380,0\n519,0\n520,1\n521,0\n780,0\n");
    let one = &json_of(&folder.abbe(&["spectrum", "line.csv", "--json"]))["spectra"][0];
    assert_eq!(one["in_gamut"], false);
    assert!(numbers(&one["rgb_encoded"])[0] < -0.1, "{one}");
    assert!(one["hex"].as_str().unwrap().starts_with('#'));
    assert!((numbers(&one["dominant"]["wavelength_nm"])[0] - 520.0).abs() < 1e-2, "{one}");
    assert!((numbers(&one["dominant"]["excitation_purity"])[0] - 1.0).abs() < 1e-3, "{one}");
    assert_eq!((&one["light"]["cct_kelvin"], &one["light"]["ra"]), (&Value::Null, &Value::Null));
    let text = folder.abbe(&["spectrum", "line.csv"]);
    assert!(text.silently().contains("(moved into the gamut)"), "{text:?}");
    assert!(text.out.contains("too far from the Planckian locus"), "{text:?}");
}

#[test]
fn white_grey_and_black() {
    let folder = Folder::new();
    folder.write("greys.csv", "nm,white,grey,black\n380,1,0.5,0\n780,1,0.5,0\n");
    for light in ["D65", "A", "2856K", "FL11", "hps"] {
        let run = folder.abbe(&["spectrum", "greys.csv", "--illuminant", light, "--json"]);
        let [white, grey, black] = [0, 1, 2].map(|i| json_of(&run)["spectra"][i].clone());
        assert_near(&white["rgb_linear"], &[1.0; 3], light);
        assert_near(&white["lab"], &[100.0, 0.0, 0.0], light);
        assert_near(&grey["rgb_linear"], &[0.5; 3], light);
        assert_eq!(
            (&white["hex"], &grey["hex"], &black["hex"]),
            (&json!("#ffffff"), &json!("#bcbcbc"), &json!("#000000"))
        );
        assert_eq!((&black["xy"], &black["dominant"]), (&Value::Null, &Value::Null));
        assert_eq!((&black["xyz"], &black["lab"]), (&json!([0.0, 0.0, 0.0]), &json!([0.0, 0.0, 0.0])));
    }
    // A black emission has no colour, but it is no error.
    let black = &json_of(&folder.abbe(&["spectrum", "greys.csv", "--as", "emission", "--column", "black", "--json"]));
    assert_eq!(black["spectra"][0]["light"]["cct_kelvin"], Value::Null);
    assert!(folder.abbe(&["spectrum", "greys.csv", "--column", "black"]).silently().contains("none (black)"));
}

#[test]
fn the_adaptation_can_be_chosen() {
    let (folder, file) = (Folder::new(), data("reflectances/colorchecker_n_ohta.csv"));
    let linear = |adaptation: &str| {
        let args = ["spectrum", &file, "--illuminant", "A", "--column", "white-9.5-.05-d", "--adaptation", adaptation];
        numbers(&json_of(&folder.abbe(&[&args[..], &["--json"]].concat()))["spectra"][0]["rgb_linear"])
    };
    let [none, bradford, cat16] = ["none", "bradford", "cat16"].map(linear);
    assert!(none[0] > 1.5 && none[2] < 0.4, "orange under a lamp: {none:?}");
    assert!((bradford[0] - bradford[2]).abs() < 0.02 && bradford != cat16, "{bradford:?} {cat16:?}");
}

#[test]
fn every_way_in_gives_the_same_numbers() {
    let folder = Folder::new();
    let rows = [(380.0, 0.1), (500.0, 0.75), (600.5, 0.25), (780.0, 0.5)];
    let csv: String = rows.iter().map(|(nm, v)| format!("{nm},{v}\n")).collect();
    folder.write("a.csv", &csv);
    folder.write("b.csv", format!("# measured\r\nwavelength;r\r\n{}", csv.replace(',', " ; ").replace('\n', "\r\n")));
    folder.write("c.tsv", csv.replace(',', "\t"));
    folder.write("d.spd", csv.replace([',', '\n'], " "));
    let samples = rows.map(|(nm, v)| format!("<SpectralData wavelength=\"{nm}\">{v}</SpectralData>")).concat();
    let spdx = format!("<IESTM2714><SpectralDistribution>{samples}</SpectralDistribution></IESTM2714>");
    folder.write("e.spdx", &spdx);
    folder.write("f.csv", csv.lines().map(|line| line.replace(',', ",1,") + "\n").collect::<String>());
    folder.write("g.csv", rows.map(|(nm, v)| format!("{nm},{}\n", 100.0 * v)).concat());
    let colour = |run: Run, i: usize| json_of(&run)["spectra"][i]["xyz"].clone();
    let xyz = colour(folder.abbe(&["spectrum", "a.csv", "--as", "reflectance", "--json"]), 0);
    for file in ["b.csv", "c.tsv", "d.spd", "e.spdx"] {
        assert_eq!(colour(folder.abbe(&["spectrum", file, "--as", "reflectance", "--json"]), 0), xyz, "{file}");
    }
    assert_eq!(colour(folder.abbe(&["spectrum", "f.csv", "--as", "reflectance", "--json"]), 1), xyz);
    for text in [&csv, &spdx] {
        let run = folder.abbe_with_stdin(&["spectrum", "-", "--as", "transmittance", "--json"], text);
        assert_eq!(json_of(&run)["file"], "<stdin>");
        assert_eq!(colour(run, 0), xyz);
    }
    let percent = folder.abbe(&["spectrum", "g.csv", "--as", "reflectance", "--percent", "--json"]);
    assert_near(&colour(percent, 0), &numbers(&xyz), "percent");
}

#[test]
fn what_the_values_are_follows_from_the_file_or_the_flags() {
    let folder = Folder::new();
    folder.write("plain.csv", "380,0.5\n780,0.5\n");
    folder.write("named.csv", "nm,transmittance\n380,0.5\n780,0.5\n");
    let quantity = |args: &[&str]| json_of(&folder.abbe(&[&["spectrum", "--json"], args].concat()))["as"].clone();
    assert_eq!(quantity(&["plain.csv"]), "emission");
    assert_eq!(quantity(&["plain.csv", "--illuminant", "A"]), "reflectance");
    assert_eq!(quantity(&["named.csv"]), "transmittance");
    assert_eq!(quantity(&["named.csv", "--as", "emission", "--illuminant", "A"]), "emission");
}

#[test]
fn a_light_can_be_a_file() {
    let folder = Folder::new();
    folder.write("paint.csv", "380,0.2\n780,0.8\n");
    folder.write("lamp.csv", "380,1\n780,3\n");
    folder.write("infrared.csv", "800,1\n900,1\n");
    folder.write("dark.csv", "380,0\n780,0\n");
    folder.write("two.csv", "380,1,2\n780,1,2\n");
    let answer = json_of(&folder.abbe(&["spectrum", "paint.csv", "--illuminant", "lamp.csv", "--json"]));
    assert_eq!((&answer["illuminant"]["name"], &answer["as"]), (&json!("lamp"), &json!("reflectance")));
    for (light, parts) in [
        ("infrared.csv", ["infrared.csv: wavelengths 800–900 nm", "expected"]),
        ("dark.csv", ["dark.csv: luminance 0", "expected a lamp"]),
        ("two.csv", ["two.csv: 2 spectra", "expected one"]),
        ("no.csv", ["no.csv: cannot be read", ""]),
        ("-3K", ["--illuminant: temperature -3 K", "expected a positive"]),
        ("1K", ["--illuminant: temperature 1 K", "from 500 to 1e9"]),
    ] {
        folder.abbe(&["spectrum", "paint.csv", &format!("--illuminant={light}")]).fails(3, &parts);
    }
}

/// Name, content, and what the one line has to say.
const BAD: [(&str, &str, &str); 25] = [
    ("unordered.csv", "400,1\n390,1\n", "line 2: wavelength 390 nm after 400 nm; expected ascending"),
    ("descending.csv", "780,1\n770,1\n", "line 2: wavelength 770 nm after 780 nm; expected ascending"),
    ("duplicate.csv", "nm,v\n400,1\n400,2\n", "line 3: wavelength 400 nm twice; expected each once"),
    ("nan.csv", "400,1\n500,nan\n", "line 2: NaN at 500 nm; expected finite"),
    ("inf.csv", "400,1\n500,-inf\n", "line 2: -inf at 500 nm; expected finite"),
    ("nan-wavelength.csv", "nan,1\n500,1\n", "line 1: 0 at NaN nm; expected finite"),
    ("micrometres.csv", "0.38,1\n0.78,1\n", "wavelengths up to 0.78 look like µm; expected nm"),
    ("metres.csv", "3.8e-7,1\n7.8e-7,1\n", "wavelengths up to 7.8e-7 look like m; expected nm"),
    ("angstroms.csv", "3800,1\n7800,1\n", "wavelengths 3800–7800 nm miss the visible"),
    ("wavenumbers.csv", "12800,1\n26000,1\n", "look like wavenumbers in cm⁻¹"),
    ("empty.csv", "", "no samples; expected"),
    ("comments.csv", "# nothing\n\n", "no samples; expected"),
    ("header.csv", "nm,value\n", "no samples; expected"),
    ("empty.spd", " \n", "no samples; expected"),
    ("empty.spdx", "<IESTM2714/>", "no samples; expected"),
    (
        "infrared.csv",
        "900,1\n1700,1\n",
        "wavelengths 900–1700 nm miss the visible; expected samples in nm within 380–780 nm",
    ),
    ("ultraviolet.csv", "200,1\n380,1\n", "wavelengths 200–380 nm miss the visible"),
    ("single.csv", "550,1\n", "one sample alone, at 550 nm; expected at least two"),
    ("word.csv", "400,1\n500,one\n", "line 2: \"one\"; expected a number"),
    ("decimal-comma.csv", "400;0,5\n", "line 1: \"0,5\"; expected a number with a decimal point"),
    ("ragged.csv", "400,1,2\n500,1\n", "line 2: 2 columns; expected 3"),
    ("one-column.csv", "400\n500\n", "line 1: 1 column; expected at least two"),
    ("transposed.csv", "name,400,500,600\nred,0.1,0.2,0.3\n", "line 2: wavelengths along the line of names"),
    ("negative.csv", "-400,1\n500,1\n", "line 1: wavelength -400 nm; expected a positive"),
    ("cell.csv", "nm,a,b\n380,1,2\n780,1,x\n", "line 3, column \"b\": \"x\"; expected a number"),
];

#[test]
fn bad_files_are_refused_in_one_line_that_says_where() {
    let folder = Folder::new();
    for (name, text, says) in BAD {
        folder.write(name, text);
        for flags in [&["--json"][..], &["--as", "reflectance", "--plot", "out.svg"], &["-q", "--csv"]] {
            folder.abbe(&[&["spectrum", name], flags].concat()).fails(3, &[&format!("{name}: "), says]);
        }
        let stdin = folder.abbe_with_stdin(&["spectrum", "-"], text);
        if !name.ends_with(".spd") {
            stdin.fails(3, &["<stdin>: ", says]);
        }
    }
    folder.write("latin.csv", b"400,1\n# \xb5m\n");
    folder.abbe(&["spectrum", "latin.csv"]).fails(3, &["latin.csv: line 2: is not UTF-8"]);
    folder.write("a.xlsx", "");
    folder.abbe(&["spectrum", "a.xlsx"]).fails(3, &["a.xlsx: extension \"xlsx\"; expected .csv"]);
    folder.abbe(&["spectrum", "no.csv"]).fails(3, &["no.csv: cannot be read"]);
    folder.abbe(&["spectrum", "."]).fails(3, &[".: "]);
    assert!(!folder.files().contains(&"out.svg".to_owned()), "a failed run wrote a picture");
}

#[test]
fn doubtful_files_get_a_named_warning_and_a_result() {
    let folder = Folder::new();
    let cases = [
        ("short.csv", "400,0.5\n700,0.5\n", "range_ends_inside_visible", "from 400 to 700 nm"),
        ("late.csv", "420,0.5\n800,0.5\n", "range_ends_inside_visible", "start at 420 nm"),
        ("early.csv", "300,0.5\n650.5,0.5\n", "range_ends_inside_visible", "end at 650.5 nm"),
        (
            "negative.csv",
            "380,-0.01\n780,0.5\n",
            "negative_values",
            "1 of 2 values are negative, the lowest -0.01 at 380 nm",
        ),
        ("fluorescent.csv", "380,0.5\n780,1.25\n", "above_one", "1.25 (at 780 nm)"),
        ("percent.csv", "380,10\n780,90\n", "looks_like_percent", "--percent"),
    ];
    for (name, text, warning, says) in cases {
        folder.write(name, text);
        let run = folder.abbe(&["spectrum", name, "--as", "reflectance", "--json"]);
        let found = &json_of(&run)["spectra"][0]["warnings"];
        assert_eq!((found.as_array().unwrap().len(), &found[0]["name"]), (1, &json!(warning)), "{name}");
        assert_eq!(run.err.lines().count(), 1, "{run:?}");
        let (prefix, suffix) = (format!("warning: {name}: "), format!("[{warning}]\n"));
        assert!(run.err.starts_with(&prefix) && run.err.ends_with(&suffix) && run.err.contains(says), "{run:?}");
        folder.abbe(&["spectrum", name, "--as", "reflectance", "-q"]).silently();
    }
    // What columns share is told once.
    folder.write("many.csv", "nm,a,b,c\n400,1,1,-1\n700,1,1,1\n");
    let run = folder.abbe(&["spectrum", "many.csv"]);
    let lines: Vec<&str> = run.succeeds().err.lines().collect();
    assert_eq!(lines.len(), 3, "{run:?}");
    assert!(lines[0].starts_with("warning: many.csv: 2 of 3 columns: samples reach from 400 to 700 nm"), "{run:?}");
    assert!(lines[2].starts_with("warning: many.csv: column \"c\": 1 of 2 values are negative"), "{run:?}");
}

#[test]
fn flags_that_make_no_sense_exit_with_2_in_one_line() {
    let folder = Folder::new();
    folder.write("a.csv", "380,1\n780,1\n");
    let cases: [(&[&str], &[&str]); 11] = [
        (&["--as", "reflectanze"], &["--as", "reflectance"]),
        (&["--observer", "1931"], &["--observer", "1931-2"]),
        (&["--space", "srgbb"], &["--space", "srgb"]),
        (&["--adaptation", "bradfort"], &["--adaptation", "bradford"]),
        (&["--illuminant", "D66"], &["--illuminant", "did you mean \"D65\"?"]),
        (&["--illuminant", "F11"], &["--illuminant", "did you mean \"FL11\"?"]),
        (&["--json", "--csv"], &["--json", "--csv"]),
        (&["--plot", "a.png"], &["--plot a.png", ".svg"]),
        (&["--plot", "-", "--json"], &["--plot -", "stdout"]),
        (&["--colour"], &["--colour"]),
        (&["b.csv"], &["b.csv"]),
    ];
    for (flags, says) in cases {
        folder.abbe(&[&["spectrum", "a.csv"], flags].concat()).fails(2, says);
    }
    folder.abbe(&["spectrum"]).fails(2, &["<FILE>"]);
    folder.write("two.csv", "nm,red,green\n380,1,1\n780,1,1\n");
    folder.abbe(&["spectrum", "two.csv", "--column", "gren"]).fails(3, &["two.csv", "did you mean \"green\"?"]);
}

#[test]
fn text_and_csv_have_their_shapes() {
    let (folder, file) = (Folder::new(), data("reflectances/colorchecker_n_ohta.csv"));
    let args = ["spectrum", &file, "--illuminant", "A"];
    let block = folder.abbe(&[&args[..], &["--column", "dark-skin"]].concat());
    let labels: Vec<&str> = block.silently().lines().skip(1).map(|line| line[..12].trim_end()).collect();
    let expected = ["XYZ", "xy", "Lab", "RGB linear", "RGB encoded", "hex", "dominant", "light", "CCT", "rendering"];
    assert_eq!(labels, expected, "{block:?}");
    assert!(
        block.out.starts_with("dark-skin: reflectance under A, observer 1931-2\nXYZ          0.147881    0.109798")
    );
    assert!(block.out.contains("\nhex          #7b503f\n") && block.out.contains("CCT          2855.6 K"), "{block:?}");
    let table = folder.abbe(&args);
    assert_eq!(table.silently().lines().count(), 2 + 24);
    assert!(table.out.lines().nth(2).unwrap().starts_with("dark-skin "), "{table:?}");

    let csv = folder.abbe(&[&args[..], &["--csv"]].concat());
    let rows: Vec<Vec<&str>> = csv.silently().lines().map(|line| line.split(',').collect()).collect();
    assert!(rows.len() == 25 && rows.iter().all(|row| row.len() == rows[0].len()), "{csv:?}");
    assert_eq!((rows[0][0], rows[0][2], rows[1][0]), ("name", "Y", "dark-skin"));
    assert!((rows[1][2].parse::<f64>().unwrap() - PATCHES[0].xyz[1]).abs() < 1e-12);
    folder.write("q.csv", "nm,\"a, \"\"b\"\"\"\n380,1\n780,1\n");
    let quoted = folder.abbe(&["spectrum", "q.csv", "--csv"]);
    assert!(quoted.silently().lines().nth(1).unwrap().starts_with("\"a, \"\"b\"\"\",1"), "{quoted:?}");
}

#[test]
fn colours_of_terminals_never_go_into_pipes() {
    let folder = Folder::new();
    folder.write("a.csv", "nm,\u{1b}[31mred\n380,1\n780,1\n");
    for no_color in [None, Some("1")] {
        let mut command = folder.command(&["spectrum", "a.csv"]);
        command.env_remove("NO_COLOR").env("TERM", "xterm-256color").env("COLORTERM", "truecolor");
        no_color.map(|value| command.env("NO_COLOR", value));
        let output = command.output().unwrap();
        assert!(output.status.success() && !output.stdout.contains(&0x1b), "{output:?}");
    }
}

#[test]
fn plots_are_whole_pictures_and_replace_only_when_they_are() {
    let folder = Folder::new();
    folder.write("a.csv", "nm,<red> & \"co\"\n380,0.1\n600,0.9\n780,0.5\n");
    let run = folder.abbe(&["spectrum", "a.csv", "--as", "reflectance", "--plot", "out.svg"]);
    assert!(run.silently().starts_with("<red> & \"co\": reflectance"), "{run:?}");
    let svg = folder.read("out.svg");
    let document = roxmltree::Document::parse(&svg).unwrap();
    let texts: Vec<&str> = document.descendants().filter_map(|n| n.text()).collect();
    for text in ["<red> & \"co\"", "wavelength (nm)", "Planckian locus", "srgb", "D65", "520", "reflectance"] {
        assert!(texts.contains(&text), "no {text:?} in {texts:?}");
    }
    assert!(svg.contains("prefers-color-scheme:dark"));
    assert!(!svg.contains("NaN") && !svg.contains("inf\""), "a number is missing");
    assert_eq!(folder.files(), ["a.csv", "out.svg"], "nothing temporary is left");
    // To stdout, alone.
    let piped = folder.abbe(&["spectrum", "a.csv", "--as", "reflectance", "--plot", "-"]);
    assert_eq!(piped.silently(), svg);
    // Many curves, black ones, a dense one: still a picture.
    folder.write("odd.csv", "nm,black,negative\n380,0,-1\n780,0,-2\n");
    let dense: String = (0..40_000).map(|i| format!("{},{}\n", 380.0 + 0.01 * f64::from(i), i % 7)).collect();
    folder.write("dense.csv", dense);
    for file in ["odd.csv", "dense.csv", &data("illuminants/fluorescent.csv")] {
        folder.abbe(&["spectrum", file, "-q", "--plot", "x.svg"]).silently();
        let svg = folder.read("x.svg");
        assert!(roxmltree::Document::parse(&svg).is_ok() && !svg.contains("NaN"), "{file}");
        assert!(svg.len() < 300_000, "{file}: {} bytes", svg.len());
    }
    folder
        .abbe(&["spectrum", "a.csv", "--plot", "no/such/folder.svg"])
        .fails(1, &["no/such/folder.svg", "cannot write"]);
}

#[test]
fn upsampled_colours_come_back() {
    let folder = Folder::new();
    let colour_of = |csv: &str, space: &str| {
        let args = ["spectrum", "-", "--space", space, "--json", "-q"];
        numbers(&json_of(&folder.abbe_with_stdin(&args, csv))["spectra"][0]["rgb_linear"])
    };
    for (color, linear) in [
        (&["0.8", "0.3", "0.05"][..], [0.8, 0.3, 0.05]),
        (&["1", "1", "1"], [1.0; 3]),
        (&["0", "0", "0"], [0.0; 3]),
        // 0x88 / 255 decoded by IEC 61966-2-1.
        (&["#ff8800"], [1.0, 0.246_201_326_704_523, 0.0]),
        (&["f80"], [1.0, 0.246_201_326_704_523, 0.0]),
        (&["1", "0.5333333333333333", "0", "--encoded"], [1.0, 0.246_201_326_704_523, 0.0]),
        (&["0.25", "0.5", "0.5", "--space", "display-p3", "--linear"], [0.25, 0.5, 0.5]),
    ] {
        let run = folder.abbe(&[&["upsample"], color].concat());
        assert!(run.silently().lines().nth(1) == Some("wavelength_nm,reflectance"), "{run:?}");
        let space = if color.contains(&"display-p3") { "display-p3" } else { "srgb" };
        for (found, wanted) in colour_of(&run.out, space).iter().zip(linear) {
            assert!((found - wanted).abs() < 1e-9, "{color:?}: {found} {wanted}");
        }
    }
    let emission = folder.abbe(&["upsample", "12", "3", "0.5", "--as", "emission"]);
    let back = colour_of(emission.silently(), "srgb");
    assert!(back.iter().zip([12.0, 3.0, 0.5]).all(|(a, b)| (a - b).abs() < 1e-8), "{back:?}");
}

#[test]
fn methods_say_how_far_off_they_are() {
    let folder = Folder::new();
    let upsample = |args: &[&str]| folder.abbe(&[&["upsample", "0.9", "0.2", "0.1"], args].concat());
    let mut spectra = Vec::new();
    for method in ["natural", "smoothest", "jakob-hanika", "mallett", "smits", "smits-linear", "otsu", "meng"] {
        let run = upsample(&["--method", method, "--json"]);
        let answer = json_of(&run);
        assert_eq!(answer["method"], method);
        let (error, warnings) = (numbers(&answer["round_trip"]["largest_error"])[0], &answer["warnings"]);
        let is_exact = ["natural", "smoothest", "jakob-hanika"].contains(&method);
        assert!(if is_exact { error < 1e-9 } else { error < 0.1 }, "{method}: {error}");
        assert_eq!(warnings.as_array().unwrap().iter().any(|w| w["name"] == "color_missed"), error > 1e-6, "{answer}");
        assert_eq!(run.err.contains("[color_missed]"), error > 1e-6, "{run:?}");
        spectra.push(numbers(&answer["values"]));
    }
    assert!((1..8).all(|i| spectra[i] != spectra[0]), "two methods are the same");
    assert_eq!(upsample(&[]).silently(), upsample(&["--method", "natural"]).silently());
    upsample(&["--method", "smit"]).fails(2, &["'smit'", "'smits'"]);
    upsample(&["--method", "smits", "-q"]).silently();
}

#[test]
fn colours_without_a_reflectance_are_projected_on_demand() {
    let folder = Folder::new();
    let green = ["upsample", "0", "1", "0", "--space", "rec2020"];
    folder.abbe(&green).fails(3, &["cannot be a reflectance", "--project"]);
    let run = folder.abbe(&[&green[..], &["--project", "--json"]].concat());
    let answer = json_of(&run);
    assert!(
        run.err.starts_with("warning: no reflectance has this colour") && run.err.ends_with("[projected]\n"),
        "{run:?}"
    );
    let kept = numbers(&answer["saturation_kept"])[0];
    assert!(kept > 0.5 && kept < 1.0, "{answer}");
    assert!(numbers(&answer["values"]).iter().all(|v| (0.0..=1.0).contains(v)));
    // What needs no projection is what it is without.
    let plain = ["upsample", "#336699"];
    assert_eq!(folder.abbe(&[&plain[..], &["--project"]].concat()).silently(), folder.abbe(&plain).silently());
}

#[test]
fn emissions_can_be_tinted_lamps() {
    let folder = Folder::new();
    let white = folder.abbe(&["upsample", "1", "1", "1", "--as", "emission", "--illuminant", "A"]);
    let args = ["spectrum", "-", "--json"];
    let answer = json_of(&folder.abbe_with_stdin(&args, white.silently()));
    assert_eq!(answer["as"], "emission");
    // White is the lamp itself: CIE A at Y = 1.
    let one = &answer["spectra"][0];
    assert!((numbers(&one["xyz"])[1] - 1.0).abs() < 1e-12 && (numbers(&one["xy"])[0] - 0.44758).abs() < 5e-5, "{one}");
    folder.abbe(&["upsample", "1", "0", "0", "--illuminant", "A"]).fails(2, &["--as emission"]);
    folder.abbe(&["upsample", "1", "0", "0", "--as", "emission", "--method", "otsu"]).fails(2, &["--method"]);
}

#[test]
fn upsample_writes_files_and_json() {
    let folder = Folder::new();
    let run = folder.abbe(&["upsample", "#336699", "-o", "out.csv", "--plot", "out.svg", "--json"]);
    let answer: Value = serde_json::from_str(run.silently()).unwrap();
    assert_eq!((&answer["space"], &answer["as"]), (&json!("srgb"), &json!("reflectance")));
    assert_near(&answer["rgb_encoded"], &[0.2, 0.4, 0.6], "encoded");
    assert!(numbers(&answer["round_trip"]["largest_error"])[0] < 1e-9, "{answer}");
    let (nm, values) = (numbers(&answer["wavelengths_nm"]), numbers(&answer["values"]));
    assert!(nm.len() == values.len() && nm[0] == 360.0 && values.iter().all(|v| (0.0..=1.0).contains(v)));
    assert_eq!(folder.files(), ["out.csv", "out.svg"]);
    assert_eq!(folder.read("out.csv").lines().count(), 2 + nm.len());
    assert!(roxmltree::Document::parse(&folder.read("out.svg")).is_ok());
    assert!(folder.abbe(&["upsample", "#336699", "-o", "out.csv"]).silently().is_empty());
    let piped = folder.abbe(&["upsample", "#336699", "-o", "-"]);
    assert_eq!(piped.silently(), folder.read("out.csv"));
}

#[test]
fn colours_that_are_none_are_refused() {
    let folder = Folder::new();
    let cases: [(&[&str], i32, &str); 12] = [
        (&["255", "136", "0"], 3, "expected components of a reflectance within [0, 1]"),
        (&["-0.1", "0", "0"], 3, "-0.1 in"),
        (&["nan", "0", "0"], 3, "expected finite"),
        (&["0.5", "0.5"], 2, "two components; expected R G B"),
        (&["0.5", "0.5", "red"], 2, "\"red\"; expected a number"),
        (&["#ff88"], 2, "\"#ff88\"; expected a hexadecimal colour"),
        (&["orange"], 2, "\"orange\"; expected a hexadecimal colour"),
        (&["#ff8800", "--linear"], 2, "are encoded"),
        (&["1", "0", "0", "--linear", "--encoded"], 2, "--linear"),
        (&["1", "0", "0", "--space", "srbg"], 2, "srgb"),
        (&["1", "0", "0", "--json", "-o", "-"], 2, "stdout"),
        (&[], 2, "R G B"),
    ];
    for (args, code, says) in cases {
        folder.abbe(&[&["upsample"], args].concat()).fails(code, &[says]);
    }
}

#[test]
fn completions_know_the_commands_and_their_values() {
    let folder = Folder::new();
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let run = folder.abbe(&["completions", shell]);
        for word in ["spectrum", "upsample", "illuminant", "completions", "render"] {
            assert!(run.silently().contains(word), "{shell}: no {word}");
        }
    }
    assert!(folder.abbe(&["completions", "bash"]).out.contains("transmittance"));
    folder.abbe(&["completions", "tcsh"]).fails(2, &["tcsh", "bash"]);
}

#[test]
fn a_reader_that_goes_away_is_no_error() {
    let folder = Folder::new();
    let mut child = folder.command(&["upsample", "0.5", "0.2", "0.1"]).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success() && output.stderr.is_empty(), "{output:?}");
}
