//! What is compared with what.

use super::work::Work;
use crate::Result;
use crate::cli::names::{INTEGRATORS, named};
use crate::cli::usage;
use crate::scene::{Integrator, RenderSettings};

const KEYS: [&str; 3] = ["integrator", "max-depth", "adaptive"];

/// One way to render.
#[derive(Debug, Clone, PartialEq)]
pub struct Variant {
    /// Name in tables and plots.
    pub name: String,
    /// Renderer and settings.
    pub kind: Kind,
}

/// Ways to render.
#[derive(Debug, Clone, PartialEq)]
pub enum Kind {
    /// abbe, with these settings instead of the scene's.
    Abbe {
        /// Technique.
        integrator: Option<Integrator>,
        /// Largest number of scattering events.
        max_depth: Option<u32>,
        /// Whether pixels get samples by their noise.
        adaptive: Option<bool>,
    },
    /// Another program.
    Command {
        /// Shell command with the placeholders that are replaced.
        template: String,
        /// Factor of its pictures; `None` makes the means equal.
        scale: Option<f64>,
    },
}

impl Kind {
    /// The settings of abbe for a scene.
    pub fn settings(&self, work: &Work, samples_per_pixel: u64, seed: u64) -> RenderSettings {
        let mut settings = RenderSettings { samples_per_pixel, seed, ..work.compiled.render };
        if let Self::Abbe { integrator, max_depth, adaptive } = self {
            settings.integrator = integrator.unwrap_or(settings.integrator);
            settings.max_depth = max_depth.unwrap_or(settings.max_depth);
            settings.adaptive = adaptive.unwrap_or(settings.adaptive);
        }
        settings
    }
}

/// All combinations of `KEY=A,B` and all of `NAME=COMMAND`. Without any of the former: abbe as the scene says.
pub fn all(vary: &[String], against: &[String], scale: &str) -> Result<Vec<Variant>> {
    let kind = Kind::Abbe { integrator: None, max_depth: None, adaptive: None };
    let none = Variant { name: String::new(), kind };
    let mut variants = vec![none];
    for text in vary {
        let (key, values) = text
            .split_once('=')
            .filter(|(_, values)| !values.is_empty())
            .ok_or_else(|| usage(format!("--vary {text}: expected KEY=A,B, such as integrator=hero,auto")))?;
        let mut varied = Vec::new();
        for variant in &variants {
            for value in values.split(',') {
                varied.push(with(variant, key, value)?);
            }
        }
        variants = varied;
    }
    if vary.is_empty() {
        variants[0].name = "abbe".into();
    }
    for text in against {
        variants.push(command(text, scale)?);
    }
    for (i, variant) in variants.iter().enumerate() {
        if variants[..i].iter().any(|other| other.name == variant.name) {
            return Err(usage(format!("{:?} is there twice; expected different variants", variant.name)));
        }
    }
    Ok(variants)
}

/// A variant with one more setting.
fn with(variant: &Variant, key: &str, value: &str) -> Result<Variant> {
    let mut kind = variant.kind.clone();
    let Kind::Abbe { integrator, max_depth, adaptive } = &mut kind else { return Ok(variant.clone()) };
    match key {
        "integrator" => *integrator = Some(named("--vary integrator", value, INTEGRATORS)?),
        "max-depth" => {
            let depth = value.parse().ok().filter(|d| (1..=1 << 20).contains(d));
            *max_depth =
                Some(depth.ok_or_else(|| usage(format!("--vary max-depth: {value:?}; expected a number above 0")))?);
        }
        "adaptive" => {
            let switch = [("on", true), ("off", false)].into_iter().find(|(name, _)| *name == value);
            let (_, on) = switch.ok_or_else(|| usage(format!("--vary adaptive: {value:?}; expected on or off")))?;
            *adaptive = Some(on);
        }
        _ => {
            let message = format!("--vary {key}: no such setting; expected one of {}", KEYS.join(", "));
            return Err(usage(message).nearest(key, KEYS));
        }
    }
    let told = if key == "integrator" { value.to_owned() } else { format!("{key} {value}") };
    let name = if variant.name.is_empty() { told } else { format!("{}, {told}", variant.name) };
    Ok(Variant { name, kind })
}

fn command(text: &str, scale: &str) -> Result<Variant> {
    let (name, template) = text
        .split_once('=')
        .filter(|(name, command)| !name.trim().is_empty() && command.contains("{spp}") && command.contains("{out}"))
        .ok_or_else(|| usage(format!("--against {text}: expected NAME=COMMAND with {{spp}} and {{out}} in it")))?;
    let factor = |text: &str| text.parse().ok().filter(|s: &f64| s.is_finite() && *s > 0.0);
    let scale = match scale {
        "auto" => None,
        _ => Some(
            factor(scale)
                .ok_or_else(|| usage(format!("--against-scale {scale}: expected a positive factor, or auto")))?,
        ),
    };
    Ok(Variant { name: name.trim().into(), kind: Kind::Command { template: template.into(), scale } })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ErrorKind;

    fn names(vary: &[&str], against: &[&str]) -> Result<Vec<String>> {
        let owned = |list: &[&str]| list.iter().map(|s| s.to_string()).collect::<Vec<_>>();
        Ok(all(&owned(vary), &owned(against), "auto")?.into_iter().map(|v| v.name).collect())
    }

    #[test]
    fn combinations() {
        assert_eq!(names(&[], &[]).unwrap(), ["abbe"]);
        let against = "other=render -s {spp} -o {out}";
        assert_eq!(names(&["integrator=hero,auto"], &[against]).unwrap(), ["hero", "auto", "other"]);
        let all = names(&["integrator=path,auto", "max-depth=4,8"], &[]).unwrap();
        assert_eq!(all, ["path, max-depth 4", "path, max-depth 8", "auto, max-depth 4", "auto, max-depth 8"]);
    }

    #[test]
    fn refusals() {
        let message = |vary: &[&str], against: &[&str]| {
            let error = names(vary, against).unwrap_err();
            assert_eq!(error.kind, ErrorKind::Usage);
            error.to_string()
        };
        assert!(message(&["integrater=path"], &[]).ends_with("did you mean \"integrator\"?"));
        assert!(message(&["integrator=heroo"], &[]).ends_with("did you mean \"hero\"?"));
        assert!(message(&["lanes=4"], &[]).contains("no such setting"));
        assert!(message(&["integrator"], &[]).contains("expected KEY=A,B"));
        assert!(message(&["max-depth=0"], &[]).contains("above 0"));
        assert!(message(&["adaptive=yes"], &[]).contains("expected on or off"));
        assert!(message(&["integrator=path,path"], &[]).contains("twice"));
        assert!(message(&[], &["x=render {spp}"]).contains("{spp} and {out}"));
    }
}
