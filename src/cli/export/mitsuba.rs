//! Mitsuba 3 XML, for the spectral variants. `spp` and `seed` are parameters of the file.

use super::cannot;
use super::parts::{Object, Parts, Shape, Surface, Table};
use crate::Result;
use crate::scene::description::{FilterKind, FovAxis, LightKind};
use glam::{DAffine3, DVec3};
use std::fmt::Write;

const NAME: &str = "Mitsuba";

/// The scene file.
pub fn text(parts: &Parts) -> Result<String> {
    let mut out = format!(
        "<!-- {} by {} -->\n<scene version=\"3.0.0\">\n<default name=\"spp\" value=\"{}\"/>\n\
         <default name=\"seed\" value=\"0\"/>\n\
         <integrator type=\"path\"><integer name=\"max_depth\" value=\"{}\"/></integrator>\n",
        parts.title.replace("--", "- -"),
        crate::VERSION,
        parts.samples_per_pixel,
        // Mitsuba counts the segments of a path.
        u64::from(parts.max_depth) + 1
    );
    sensor(&mut out, parts)?;
    for object in &parts.objects {
        shape(&mut out, object)?;
    }
    for (kind, table, at) in &parts.lights {
        light(&mut out, kind, table, at)?;
    }
    if let Some(table) = &parts.environment {
        line(&mut out, &format!("<emitter type=\"constant\">{}</emitter>", spectrum("radiance", table)));
    }
    Ok(out + "</scene>\n")
}

/// Writing to a String cannot fail.
fn line(out: &mut String, text: &str) {
    let _ = writeln!(out, "{text}");
}

fn sensor(out: &mut String, parts: &Parts) -> Result<()> {
    let (camera, film) = (&parts.camera, &parts.film);
    if film.filter != FilterKind::Box || film.filter_radius != 0.5 {
        return Err(cannot(NAME, "a filter other than the box of one pixel", "film.filter"));
    }
    let lens = match camera.aperture_radius {
        0.0 => String::new(),
        radius => format!(
            "<float name=\"aperture_radius\" value=\"{radius}\"/><float name=\"focus_distance\" value=\"{}\"/>",
            camera.focus_distance
        ),
    };
    let kind = if lens.is_empty() { "perspective" } else { "thinlens" };
    let axis = if camera.fov_axis == FovAxis::X { "x" } else { "y" };
    let [from, to, up] = [camera.from, camera.to, camera.up].map(triple);
    line(out, &format!("<sensor type=\"{kind}\">{lens}"));
    line(
        out,
        &format!("<string name=\"fov_axis\" value=\"{axis}\"/><float name=\"fov\" value=\"{}\"/>", camera.fov_degrees),
    );
    // As near and as far as floats allow without losing depth.
    line(out, "<float name=\"near_clip\" value=\"1e-4\"/><float name=\"far_clip\" value=\"1e6\"/>");
    line(
        out,
        &format!("<transform name=\"to_world\"><lookat origin=\"{from}\" target=\"{to}\" up=\"{up}\"/></transform>"),
    );
    line(
        out,
        "<sampler type=\"independent\"><integer name=\"sample_count\" value=\"$spp\"/><integer name=\"seed\" value=\"$seed\"/></sampler>",
    );
    line(
        out,
        &format!(
            "<film type=\"hdrfilm\"><integer name=\"width\" value=\"{}\"/><integer name=\"height\" value=\"{}\"/>\
         <string name=\"pixel_format\" value=\"rgb\"/><string name=\"component_format\" value=\"float32\"/>\
         <rfilter type=\"box\"/></film>\n</sensor>",
            film.width, film.height
        ),
    );
    Ok(())
}

fn triple(v: [f64; 3]) -> String {
    format!("{}, {}, {}", v[0], v[1], v[2])
}

fn spectrum(name: &str, table: &Table) -> String {
    let value = match table {
        Table::Constant(value) => value.to_string(),
        Table::Sampled(knots) => knots.iter().map(|(nm, value)| format!("{nm}:{value}")).collect::<Vec<_>>().join(", "),
    };
    format!("<spectrum name=\"{name}\" value=\"{value}\"/>")
}

fn matrix(transform: &DAffine3) -> String {
    let (m, t) = (transform.matrix3.transpose(), transform.translation);
    let rows = [(m.x_axis, t.x), (m.y_axis, t.y), (m.z_axis, t.z)];
    let rows: Vec<String> = rows.iter().map(|(row, t)| format!("{} {} {} {t}", row.x, row.y, row.z)).collect();
    format!("<transform name=\"to_world\"><matrix value=\"{} 0 0 0 1\"/></transform>", rows.join(" "))
}

fn shape(out: &mut String, object: &Object) -> Result<()> {
    let geometry = match &object.shape {
        Shape::Sphere { center, radius } => {
            let DVec3 { x, y, z } = *center;
            format!(
                "<shape type=\"sphere\"><point name=\"center\" x=\"{x}\" y=\"{y}\" z=\"{z}\"/><float name=\"radius\" value=\"{radius}\"/>"
            )
        }
        Shape::Disk(transform) => format!("<shape type=\"disk\">{}", matrix(transform)),
        Shape::Ply { file, smooth } => format!(
            // Without normals in the file Mitsuba would make smooth ones.
            "<shape type=\"ply\"><string name=\"filename\" value=\"{file}\"/><boolean name=\"face_normals\" value=\"{}\"/>",
            !smooth
        ),
    };
    let emission = match &object.emission {
        None => String::new(),
        Some((_, true)) => return Err(cannot(NAME, "emission on both sides", &object.at)),
        Some((table, false)) => format!("<emitter type=\"area\">{}</emitter>", spectrum("radiance", table)),
    };
    line(out, &format!("{geometry}{}{emission}</shape>", surface(object)?));
    Ok(())
}

fn surface(object: &Object) -> Result<String> {
    let bsdf = match &object.surface {
        Surface::Diffuse(table) => format!("<bsdf type=\"diffuse\">{}</bsdf>", spectrum("reflectance", table)),
        Surface::Mirror(table) => format!(
            "<bsdf type=\"conductor\"><string name=\"material\" value=\"none\"/>{}</bsdf>",
            spectrum("specular_reflectance", table)
        ),
        Surface::Conductor(eta, k, alpha) => {
            let (kind, facets) = facets("conductor", *alpha);
            format!("<bsdf type=\"{kind}\">{facets}{}{}</bsdf>", spectrum("eta", eta), spectrum("k", k))
        }
        Surface::Dielectric(Table::Constant(eta), alpha) => {
            let ior = |name: &str, value: f64| format!("<float name=\"{name}\" value=\"{value}\"/>");
            let (kind, facets) = facets("dielectric", *alpha);
            let media = format!("{}{}", ior("int_ior", *eta), ior("ext_ior", 1.0));
            return Ok(format!("<bsdf type=\"{kind}\">{facets}{media}</bsdf>"));
        }
        Surface::Dielectric(Table::Sampled(_), _) => {
            return Err(cannot(
                NAME,
                "an index of refraction that depends on the wavelength (expected --at NM)",
                &object.at,
            ));
        }
    };
    Ok(if object.two_sided { format!("<bsdf type=\"twosided\">{bsdf}</bsdf>") } else { bsdf })
}

/// The type of a surface with this roughness, and its parameters. Mitsuba's masking has no correlation of heights, which
/// makes very rough surfaces a little darker.
fn facets(smooth: &str, alpha: f32) -> (String, String) {
    if alpha == 0.0 {
        return (smooth.to_owned(), String::new());
    }
    let parameters = format!("<string name=\"distribution\" value=\"ggx\"/><float name=\"alpha\" value=\"{alpha}\"/>");
    (format!("rough{smooth}"), parameters)
}

fn light(out: &mut String, kind: &LightKind, table: &Table, at: &str) -> Result<()> {
    let vector = |name: &str, v: &[f64; 3]| format!("<vector name=\"{name}\" value=\"{}\"/>", triple(*v));
    let text = match kind {
        LightKind::Point { position, .. } => format!(
            "<emitter type=\"point\"><point name=\"position\" value=\"{}\"/>{}</emitter>",
            triple(*position),
            spectrum("intensity", table)
        ),
        LightKind::Directional { direction, angular_diameter_degrees: 0.0, .. } => format!(
            "<emitter type=\"directional\">{}{}</emitter>",
            vector("direction", direction),
            spectrum("irradiance", table)
        ),
        LightKind::Directional { .. } => return Err(cannot(NAME, "a disc at infinity", at)),
        LightKind::Spot { .. } => return Err(cannot(NAME, "a spot with this edge", at)),
        LightKind::Beam { .. } => return Err(cannot(NAME, "a collimated beam", at)),
    };
    line(out, &text);
    Ok(())
}
