//! A colour shown on a terminal, where there is one that wants colours.

use std::io::IsTerminal;

/// Whether stdout is a terminal that shows colours. `NO_COLOR` set to anything but nothing forbids them.
pub fn is_wanted() -> bool {
    let variable = |name| std::env::var_os(name).map(|value| value.to_string_lossy().into_owned());
    decide(std::io::stdout().is_terminal(), variable("NO_COLOR").as_deref(), variable("TERM").as_deref())
}

fn decide(is_terminal: bool, no_color: Option<&str>, term: Option<&str>) -> bool {
    is_terminal && no_color.is_none_or(str::is_empty) && term != Some("dumb")
}

/// A patch some columns wide in a 24-bit colour.
pub fn patch([r, g, b]: [u8; 3], columns: usize) -> String {
    format!("\u{1b}[48;2;{r};{g};{b}m{:columns$}\u{1b}[0m", "")
}

/// Text from a file as it may go to a terminal: without control characters, which could move its cursor.
pub fn harmless(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_for_terminals_that_want_them() {
        assert!(decide(true, None, Some("xterm-256color")) && decide(true, Some(""), None));
        assert!(!decide(false, None, Some("xterm")) && !decide(true, Some("1"), Some("xterm")));
        assert!(!decide(true, None, Some("dumb")));
    }

    #[test]
    fn a_patch_ends_its_colour() {
        assert_eq!(patch([255, 136, 0], 3), "\u{1b}[48;2;255;136;0m   \u{1b}[0m");
        assert_eq!(harmless("red\u{1b}[31m\n"), "red [31m ");
    }
}
