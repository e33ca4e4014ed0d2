//! Axes: from values to pixels, and the round numbers to label.

/// A linear map from values to pixels.
#[derive(Debug, Clone, Copy)]
pub struct Scale {
    values: [f64; 2],
    pixels: [f64; 2],
}

impl Scale {
    /// Maps the two values to the two pixels. The values must differ.
    pub fn new(values: [f64; 2], pixels: [f64; 2]) -> Self {
        Self { values, pixels }
    }

    /// The pixel of a value.
    pub fn at(&self, value: f64) -> f64 {
        let t = (value - self.values[0]) / (self.values[1] - self.values[0]);
        self.pixels[0] + t * (self.pixels[1] - self.pixels[0])
    }
}

/// Round numbers: multiples of 1, 2 or 5 times a power of ten.
#[derive(Debug, Clone, PartialEq)]
pub struct Ticks {
    /// The first and last are at or beyond the range they were made for.
    pub values: Vec<f64>,
    /// Writes a number with as many digits after the point as the steps have, or as a power of ten.
    pub labels: Vec<String>,
}

impl Ticks {
    /// About `count` round numbers that enclose a range, which must be finite and not empty.
    pub fn enclosing(from: f64, to: f64, count: f64) -> Self {
        let power = power_of_ten(decade((to - from) / count));
        let step = [1.0, 2.0, 5.0].into_iter().map(|m| m * power).find(|step| (to - from) / step <= count);
        let step = step.unwrap_or(10.0 * power);
        // A range that ends at a round number but for rounding ends there.
        let slack = 1e-9;
        let (first, last) = ((from / step + slack).floor(), (to / step - slack).ceil());
        let values: Vec<f64> = (0..=(last - first) as usize).map(|i| (first + i as f64) * step).collect();
        let largest = values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        let digits = decade(step * (1.0 + slack));
        let label = |&value: &f64| match digits {
            _ if value == 0.0 => "0".to_owned(),
            -4..=6 if largest < 1e6 => format!("{value:.*}", (-digits).max(0) as usize),
            _ => scientific(value),
        };
        let labels = values.iter().map(label).collect();
        Self { values, labels }
    }

    /// First and last value.
    pub fn range(&self) -> [f64; 2] {
        [self.values[0], self.values[self.values.len() - 1]]
    }
}

/// The exponent of ten of a positive number.
fn decade(value: f64) -> i32 {
    let text = format!("{value:e}");
    text.rsplit_once('e').and_then(|(_, exponent)| exponent.parse().ok()).unwrap_or_default()
}

fn power_of_ten(exponent: i32) -> f64 {
    format!("1e{exponent}").parse().unwrap_or(f64::MIN_POSITIVE)
}

/// One digit after the point if it is not 0, and the power of ten raised.
fn scientific(value: f64) -> String {
    let text = format!("{value:.1e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raise = |c: char| c.to_digit(10).map_or('⁻', |digit| RAISED[digit as usize]);
    format!("{}·10{}", mantissa.trim_end_matches(".0"), exponent.chars().map(raise).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scale_maps_its_ends() {
        let scale = Scale::new([380.0, 780.0], [100.0, 20.0]);
        assert_eq!([380.0, 580.0, 780.0].map(|v| scale.at(v)), [100.0, 60.0, 20.0]);
    }

    #[test]
    fn ticks_are_round_and_enclose() {
        let labels = |from, to| Ticks::enclosing(from, to, 5.0).labels.join(" ");
        assert_eq!(labels(0.0, 1.0), "0 0.2 0.4 0.6 0.8 1.0");
        assert_eq!(labels(0.0, 117.8), "0 50 100 150");
        assert_eq!(labels(-0.013, 0.09), "-0.05 0 0.05 0.10");
        assert_eq!(labels(0.0, 3e-7), "0 1·10⁻⁷ 2·10⁻⁷ 3·10⁻⁷");
        assert_eq!(labels(0.0, 2.5e13), "0 5·10¹² 1·10¹³ 1.5·10¹³ 2·10¹³ 2.5·10¹³");
    }

    #[test]
    fn ticks_enclose_any_range() {
        for exponent in -40..40 {
            let power = power_of_ten(exponent);
            for mantissa in [1.0, 1.7, 3.0, 4.99, 7.2, 9.9] {
                let to = mantissa * power;
                let ticks = Ticks::enclosing(-0.3 * to, to, 5.0);
                let [first, last] = ticks.range();
                assert!(first <= -0.3 * to * (1.0 - 1e-6) && last >= to * (1.0 - 1e-6), "{to}: {ticks:?}");
                assert!(ticks.values.len() <= 8 && ticks.values.len() >= 3, "{to}: {ticks:?}");
            }
        }
    }
}
