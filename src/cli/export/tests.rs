use super::*;
use std::fs;

const SCENE: &str = r#"{
    "camera": { "type": "perspective", "from": [0, 0, 100004], "to": [0, 0, 100000], "fov_degrees": 60 },
    "film": { "width": 8, "height": 4 },
    "render": { "max_depth": 7 },
    "spectra": { "s": { "wavelengths_nm": [400, 700], "values": [0.2, 0.5] } },
    "materials": { "d": { "type": "diffuse", "reflectance": "s" },
                   "g": { "type": "dielectric", "ior": 1.5 } },
    "objects": [
        { "shape": { "type": "sphere", "center": [0, 1, 100000], "radius": 0.5 }, "material": "g",
          "transform": [ { "translate": [1, 0, 0] } ] },
        { "shape": { "type": "quad", "origin": [-1, -1, 99999], "u": [2, 0, 0], "v": [0, 2, 0] }, "material": "d",
          "emission": 3 },
        { "shape": { "type": "disk", "center": [2, 0, 100000], "normal": [0, 1, 0], "radius": 2 }, "material": "d" } ],
    "lights": [ { "type": "point", "position": [0, 5, 100000], "intensity": 2 } ],
    "environment": { "radiance": 0.25 }
}"#;

/// A folder of its own, removed at the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("abbe-export-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn export(&self, scene: &str, format: Format, at: Option<f64>) -> Result<String> {
        let path = self.0.join("scene.json");
        fs::write(&path, scene).unwrap();
        let args = ExportArgs { scene: path, format, output: self.0.join("x.out"), at, quiet: true };
        run(&args, &mut Vec::new())?;
        Ok(fs::read_to_string(self.0.join("x.out")).unwrap())
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

#[test]
fn mitsuba_gets_what_the_scene_says() {
    let folder = Folder::new("mitsuba");
    let text = folder.export(SCENE, Format::Mitsuba, None).unwrap();
    for part in [
        "<integer name=\"max_depth\" value=\"8\"/>",
        "<lookat origin=\"0, 0, 100004\" target=\"0, 0, 100000\"",
        "<point name=\"center\" x=\"1\" y=\"1\" z=\"100000\"/><float name=\"radius\" value=\"0.5\"/>",
        "<float name=\"int_ior\" value=\"1.5\"/>",
        "<emitter type=\"area\"><spectrum name=\"radiance\" value=\"3\"/></emitter>",
        "<emitter type=\"constant\"><spectrum name=\"radiance\" value=\"0.25\"/></emitter>",
        "<spectrum name=\"intensity\" value=\"2\"/>",
        "value=\"360:0.20000000298",
        "<bsdf type=\"twosided\"><bsdf type=\"diffuse\">",
        "<boolean name=\"face_normals\" value=\"true\"/>",
        "<matrix value=\"2 0 0 2 ",
    ] {
        assert!(text.contains(part), "expected {part} in\n{text}");
    }
    // One mesh, in metres although it is far from the origin.
    let ply = crate::io::mesh::read(&folder.0.join("x-1.ply")).unwrap();
    assert_eq!((ply.positions.len(), ply.indices.len()), (4, 2));
    assert!(
        ply.positions.iter().all(|p| p.z == 99999.0 && p.x.abs() == 1.0 && p.y.abs() == 1.0),
        "{:?}",
        ply.positions
    );
    assert!(roxmltree::Document::parse(&text).is_ok());
}

/// Convex glass, which the renderer does not keep as triangles.
#[test]
fn glass_is_written_as_triangles() {
    let folder = Folder::new("glass");
    let scene = r#"{
        "camera": { "type": "perspective", "from": [0, 0, 5], "to": [0, 0, 0] },
        "film": { "width": 8, "height": 8 },
        "materials": { "glass": { "type": "dielectric", "ior": 1.5 } },
        "objects": [{ "shape": { "type": "prism", "apex_degrees": 60, "side": 1, "length": 2 }, "material": "glass",
                      "transform": [{ "translate": [3, 0, 0] }] }],
        "environment": { "radiance": 1 }
    }"#;
    folder.export(scene, Format::Mitsuba, None).unwrap();
    let ply = crate::io::mesh::read(&folder.0.join("x-0.ply")).unwrap();
    assert_eq!((ply.positions.len(), ply.indices.len()), (6, 8));
    assert!(ply.is_closed() && (ply.signed_volume() / (0.75f64.sqrt() / 2.0 * 2.0) - 1.0).abs() < 1e-6);
    assert!(ply.positions.iter().all(|p| (p.x - 3.0).abs() < 1.0), "{:?}", ply.positions);
}

#[test]
fn pbrt_gets_what_the_scene_says() {
    let folder = Folder::new("pbrt");
    let text = folder.export(SCENE, Format::Pbrt, None).unwrap();
    // 60° across 8 pixels are 2 atan(tan 30° / 2) = 32.204° across 4.
    for part in
        ["Scale -1 1 1\nLookAt 0 0 100004", "\"float fov\" 32.204", "\"spectrum eta\" [ 360 1.5 830 1.5 ]", "plymesh"]
    {
        assert!(text.contains(part), "expected {part} in\n{text}");
    }
    assert_eq!(text.matches("AttributeBegin").count(), text.matches("AttributeEnd").count());
    // ∫ ȳ dλ times the radiance.
    assert!(text.contains("\"spectrum L\" [ 360 3 830 3 ] \"float scale\" 320.5"), "{text}");
}

#[test]
fn what_cannot_be_expressed_is_refused_with_its_place() {
    let folder = Folder::new("refusals");
    let refused = |from: &str, to: &str, format, parts: &[&str]| {
        assert!(SCENE.contains(from), "{from}");
        let error = folder.export(&SCENE.replacen(from, to, 1), format, None).unwrap_err();
        let text = error.to_string();
        assert!(
            error.kind == ErrorKind::Unsupported && parts.iter().all(|part| text.contains(part)),
            "{parts:?}: {text}"
        );
    };
    let glass = "{ \"glass\": \"N-BK7\" }";
    refused("\"ior\": 1.5", &format!("\"ior\": {glass}"), Format::Mitsuba, &["objects[0]", "expected --at NM"]);
    refused("\"ior\": 1.5", "\"ior\": 1.5, \"absorption_per_m\": 1", Format::Pbrt, &["materials.g", "absorption"]);
    let point = "\"type\": \"point\", \"position\": [0, 5, 100000], \"intensity\": 2";
    let beam = "\"type\": \"beam\", \"origin\": [0, 5, 100000], \"direction\": [0, -1, 0], \"radius\": 1, \"power\": 2";
    refused(point, beam, Format::Pbrt, &["lights[0]", "a collimated beam"]);
    refused(
        "\"height\": 4",
        "\"height\": 4, \"filter\": { \"type\": \"gaussian\" }",
        Format::Mitsuba,
        &["film.filter"],
    );
    let lens = "\"type\": \"lens\", \"radii\": [1, 1], \"thickness\": 0.3, \"diameter\": 0.5";
    let sphere = "\"type\": \"sphere\", \"center\": [0, 1, 100000], \"radius\": 0.5";
    refused(sphere, lens, Format::Mitsuba, &["objects[0].shape", "a lens"]);
    let stretched = "\"transform\": [ { \"scale\": [1, 2, 1] } ]";
    refused("\"transform\": [ { \"translate\": [1, 0, 0] } ]", stretched, Format::Pbrt, &["an ellipsoid"]);
    // At a stated wavelength glass has one index.
    let scene = SCENE.replacen("\"ior\": 1.5", &format!("\"ior\": {glass}"), 1);
    let text = folder.export(&scene, Format::Mitsuba, Some(587.5618)).unwrap();
    assert!(text.contains("<float name=\"int_ior\" value=\"1.516"), "{text}");
    assert!(folder.export(&scene, Format::Pbrt, None).unwrap().contains("\"spectrum eta\" [ 360 1.53"));
    assert_eq!(folder.export(&scene, Format::Pbrt, Some(90.0)).unwrap_err().kind, ErrorKind::Usage);
}

#[test]
fn lines_keep_their_area() {
    let line = |nm: f64| crate::math::exp(-(nm - 546.07) * (nm - 546.07) / (2.0 * 0.1 * 0.1));
    let table = parts::Table::new(line);
    let expected = 0.1 * (2.0 * std::f64::consts::PI).sqrt();
    assert!((table.integral(|_| 1.0) - expected).abs() < 1e-6);
    assert_eq!(parts::Table::new(|_| 2.0), parts::Table::Constant(2.0));
}
