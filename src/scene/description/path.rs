//! JSON paths, as linked lists on the stack: free until a message wants the text.

use std::fmt;

/// Where a value stands: `objects[2].shape.radius`.
#[derive(Debug, Clone, Copy)]
pub enum Path<'p> {
    /// The whole file.
    Root,
    /// A key of an object.
    Key(&'p Path<'p>, &'p str),
    /// An item of a list.
    Index(&'p Path<'p>, usize),
}

impl fmt::Display for Path<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Path::Root => Ok(()),
            Path::Index(parent, index) => write!(f, "{parent}[{index}]"),
            Path::Key(parent, key) => {
                let plain = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | '$');
                match (parent, !key.is_empty() && key.chars().all(plain)) {
                    (Path::Root, true) => f.write_str(key),
                    (_, true) => write!(f, "{parent}.{key}"),
                    (_, false) => write!(f, "{parent}[{}]", super::text::quote(key)),
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_like_javascript() {
        let objects = Path::Key(&Path::Root, "objects");
        let object = Path::Index(&objects, 2);
        assert_eq!(Path::Key(&object, "shape").to_string(), "objects[2].shape");
        assert_eq!(Path::Key(&objects, "my glass\n").to_string(), "objects[\"my glass\\n\"]");
        assert_eq!(Path::Root.to_string(), "");
    }
}
