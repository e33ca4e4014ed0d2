//! The format of pbrt-v4.

use super::cannot;
use super::parts::{Object, Parts, Shape, Surface, Table};
use crate::Result;
use crate::color::Observer;
use crate::math;
use crate::scene::description::{FilterKind, FovAxis, LightKind};
use glam::DAffine3;
use std::fmt::Write;

const NAME: &str = "pbrt";

/// The scene file.
pub fn text(parts: &Parts) -> Result<String> {
    let mut out = format!("# {} by {}\n", parts.title, crate::VERSION);
    camera(&mut out, parts)?;
    line(&mut out, "WorldBegin");
    for object in &parts.objects {
        shape(&mut out, object)?;
    }
    for (kind, table, at) in &parts.lights {
        light(&mut out, kind, table, at)?;
    }
    if let Some(table) = &parts.environment {
        line(&mut out, &format!("LightSource \"infinite\" {}", emission("L", table)));
    }
    Ok(out)
}

/// Writing to a String cannot fail.
fn line(out: &mut String, text: &str) {
    let _ = writeln!(out, "{text}");
}

fn camera(out: &mut String, parts: &Parts) -> Result<()> {
    let (camera, film) = (&parts.camera, &parts.film);
    let radius = film.filter_radius;
    let size = format!("\"float xradius\" {radius} \"float yradius\" {radius}");
    let filter = match film.filter {
        FilterKind::Box => format!("PixelFilter \"box\" {size}"),
        FilterKind::Gaussian => format!("PixelFilter \"gaussian\" {size} \"float sigma\" {}", radius / 3.0),
        FilterKind::BlackmanHarris => return Err(cannot(NAME, "a Blackman-Harris filter", "film.filter")),
    };
    // pbrt's angle is that of the shorter side.
    let (width, height) = (f64::from(film.width), f64::from(film.height));
    let along = if camera.fov_axis == FovAxis::X { width } else { height };
    let half = math::tan(0.5 * camera.fov_degrees.to_radians()) * width.min(height) / along;
    let fov = 2.0 * math::atan2(half, 1.0).to_degrees();
    let lens = match camera.aperture_radius {
        0.0 => String::new(),
        radius => format!(" \"float lensradius\" {radius} \"float focaldistance\" {}", camera.focus_distance),
    };
    // pbrt's world is left-handed; mirrored, ours is as well.
    line(out, "Scale -1 1 1");
    line(out, &format!("LookAt {} {} {}", triple(camera.from), triple(camera.to), triple(camera.up)));
    line(out, &format!("Camera \"perspective\" \"float fov\" {fov}{lens}"));
    line(out, &format!("Sampler \"zsobol\" \"integer pixelsamples\" {}", parts.samples_per_pixel));
    line(out, &format!("Integrator \"path\" \"integer maxdepth\" {}", parts.max_depth));
    line(out, &filter);
    line(
        out,
        &format!(
            "Film \"rgb\" \"integer xresolution\" {} \"integer yresolution\" {} \"string sensor\" \"cie1931\" \
         \"bool savefp16\" false \"string filename\" \"out.exr\"",
            film.width, film.height
        ),
    );
    Ok(())
}

fn triple(v: [f64; 3]) -> String {
    format!("{} {} {}", v[0], v[1], v[2])
}

fn spectrum(name: &str, table: &Table) -> String {
    // pbrt has no constant as a parameter; two knots are one.
    let pairs = match table {
        Table::Constant(value) => format!("360 {value} 830 {value}"),
        Table::Sampled(knots) => knots.iter().map(|(nm, v)| format!("{nm} {v}")).collect::<Vec<_>>().join(" "),
    };
    format!("\"spectrum {name}\" [ {pairs} ]")
}

/// A light's spectrum. pbrt divides it by its luminous integral; the scale brings that back.
fn emission(name: &str, table: &Table) -> String {
    let scale = table.integral(|nm| Observer::cie_1931_2deg().eval(nm).y);
    format!("{} \"float scale\" {scale}", spectrum(name, table))
}

fn matrix(transform: &DAffine3) -> String {
    let columns = [transform.matrix3.x_axis, transform.matrix3.y_axis, transform.matrix3.z_axis, transform.translation];
    let rows: Vec<String> =
        columns.iter().enumerate().map(|(i, c)| format!("{} {} {} {}", c.x, c.y, c.z, u8::from(i == 3))).collect();
    format!("ConcatTransform [ {} ]", rows.join("  "))
}

fn shape(out: &mut String, object: &Object) -> Result<()> {
    let surface = surface(object)?;
    line(out, "AttributeBegin");
    line(out, &surface);
    if let Some((table, two_sided)) = &object.emission {
        line(out, &format!("AreaLightSource \"diffuse\" {} \"bool twosided\" {two_sided}", emission("L", table)));
    }
    let geometry = match &object.shape {
        Shape::Sphere { center, radius } => {
            format!("Translate {}\nShape \"sphere\" \"float radius\" {radius}", triple(center.to_array()))
        }
        Shape::Disk(transform) => format!("{}\nShape \"disk\"", matrix(transform)),
        Shape::Ply { file, .. } => format!("Shape \"plymesh\" \"string filename\" \"{file}\""),
    };
    line(out, &geometry);
    line(out, "AttributeEnd");
    Ok(())
}

fn surface(object: &Object) -> Result<String> {
    Ok(match &object.surface {
        Surface::Diffuse(table) if object.two_sided || *table == Table::Constant(0.0) => {
            format!("Material \"diffuse\" {}", spectrum("reflectance", table))
        }
        Surface::Conductor(eta, k, alpha) if object.two_sided => {
            format!("Material \"conductor\" {} {}{}", spectrum("eta", eta), spectrum("k", k), facets(*alpha))
        }
        Surface::Dielectric(eta, alpha) => {
            format!("Material \"dielectric\" {}{}", spectrum("eta", eta), facets(*alpha))
        }
        Surface::Mirror(_) => return Err(cannot(NAME, "a perfect mirror", &object.at)),
        _ => return Err(cannot(NAME, "a surface with one side", &object.at)),
    })
}

/// Parameters of roughness, GGX α as it is; none if smooth.
fn facets(alpha: f32) -> String {
    match alpha {
        0.0 => String::new(),
        alpha => format!(" \"float roughness\" {alpha} \"bool remaproughness\" false"),
    }
}

fn light(out: &mut String, kind: &LightKind, table: &Table, at: &str) -> Result<()> {
    let text = match kind {
        LightKind::Point { position, .. } => {
            format!("LightSource \"point\" \"point3 from\" [ {} ] {}", triple(*position), emission("I", table))
        }
        LightKind::Spot { position, direction, inner_degrees, outer_degrees, .. } => {
            let to = [0, 1, 2].map(|c| position[c] + direction[c]);
            format!(
                "LightSource \"spot\" \"point3 from\" [ {} ] \"point3 to\" [ {} ] \"float coneangle\" {outer_degrees} \
                 \"float conedeltaangle\" {} {}",
                triple(*position),
                triple(to),
                outer_degrees - inner_degrees,
                emission("I", table)
            )
        }
        LightKind::Directional { direction, angular_diameter_degrees: 0.0, .. } => format!(
            "LightSource \"distant\" \"point3 from\" [ 0 0 0 ] \"point3 to\" [ {} ] {}",
            triple(*direction),
            emission("L", table)
        ),
        LightKind::Directional { .. } => return Err(cannot(NAME, "a disc at infinity", at)),
        LightKind::Beam { .. } => return Err(cannot(NAME, "a collimated beam", at)),
    };
    line(out, &text);
    Ok(())
}
