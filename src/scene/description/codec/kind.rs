//! Descriptions of values, as the codecs record them.

use super::super::text::{alternatives, show};

/// Most entries of a map of the user's names.
pub const MAX_NAMES: usize = 100_000;

/// Longest string, bytes.
pub const MAX_TEXT: usize = 4096;

/// What a value can be.
pub enum Kind {
    /// A number.
    Number(Range),
    /// An integer in a range.
    Integer(Range),
    /// `true` or `false`.
    Bool,
    /// Any string.
    Text,
    /// A name, not empty; the words say of what.
    Name(&'static str),
    /// A path to a file with one of these extensions.
    File {
        /// What the file holds.
        what: &'static str,
        /// Extensions without the dot.
        extensions: &'static [&'static str],
    },
    /// One of these strings, each with its meaning.
    Choice(Vec<(&'static str, &'static str)>),
    /// A list of nothing but numbers.
    Numbers(NumbersKind),
    /// A list of anything else.
    List {
        /// What an item is called.
        what: &'static str,
        /// The items.
        item: Box<Kind>,
        /// Most items.
        max: usize,
        /// Fewest items.
        min: usize,
    },
    /// An object whose keys are the user's names.
    Map {
        /// What an entry is called.
        what: &'static str,
        /// The entries.
        item: Box<Kind>,
    },
    /// An object with known keys.
    Object(Box<Table>),
    /// One of several kinds that differ in their JSON type, each with its meaning, which may be empty.
    Either(Vec<(Kind, &'static str)>),
    /// A kind that stands in several places, by name.
    Defined(&'static str, Box<dyn Fn() -> Kind>),
}

/// A list of numbers.
#[derive(Debug, Clone, Copy)]
pub struct NumbersKind {
    /// Fewest items.
    pub min: usize,
    /// Most items.
    pub max: usize,
    /// The count must be a multiple of this.
    pub multiple_of: usize,
    /// Range of each item.
    pub item: Range,
    /// Whether items must be integers.
    pub integer: bool,
    /// Whether an item may be `null`.
    pub null: bool,
}

/// An object with known keys. `"comment"` is always allowed.
pub struct Table {
    /// With its article: "a sphere".
    pub what: &'static str,
    /// What it is.
    pub doc: &'static str,
    /// Its keys; those of all variants, where there are any.
    pub fields: Vec<Field>,
    /// The key whose value tells the variant; without one the variant's own first key does.
    pub tag: Option<&'static str>,
    /// Kinds of the object by the tag's value or by their first key.
    pub variants: Vec<(&'static str, Table)>,
    /// What holds between keys.
    pub rule: Rule,
}

/// One key of an object.
pub struct Field {
    /// The key.
    pub key: &'static str,
    /// What its value is.
    pub kind: Kind,
    /// Whether it must be there.
    pub need: Need,
    /// What it means.
    pub doc: &'static str,
}

/// Whether a key must be there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Need {
    /// It must.
    Required,
    /// It may be absent, which means something of its own.
    Optional,
    /// Absent means this JSON text.
    Default(&'static str),
}

/// What holds between the keys of an object.
#[derive(Debug, Clone, Copy)]
pub enum Rule {
    /// Nothing.
    Free,
    /// At least one of these sets of keys is complete.
    AnyOf(&'static [&'static [&'static str]]),
    /// One of these sets of keys is complete, and the others are absent.
    OneOf(&'static [&'static [&'static str]]),
}

impl Rule {
    /// The sets of keys.
    pub fn sets(self) -> &'static [&'static [&'static str]] {
        match self {
            Rule::Free => &[],
            Rule::AnyOf(sets) | Rule::OneOf(sets) => sets,
        }
    }

    /// "metal, or eta and k".
    pub fn describe(self) -> String {
        self.sets().iter().map(|keys| keys.join(" and ")).collect::<Vec<_>>().join(", or ")
    }
}

/// A range of numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// Lower end.
    pub min: f64,
    /// Upper end.
    pub max: f64,
    /// Whether the lower end itself is excluded.
    pub above: bool,
    /// Whether the upper end itself is excluded.
    pub below: bool,
}

/// Largest coordinate or length, metres.
const MAX_LENGTH: f64 = 1e30;

impl Range {
    /// Every finite number.
    pub const ANY: Range = Range::from_to(-f64::MAX, f64::MAX);
    /// x ≥ 0.
    pub const NOT_NEGATIVE: Range = Range::from_to(0.0, f64::MAX);
    /// x > 0.
    pub const POSITIVE: Range = Range::above_to(0.0, f64::MAX);
    /// [0, 1].
    pub const FRACTION: Range = Range::from_to(0.0, 1.0);
    /// A coordinate.
    pub const COORDINATE: Range = Range::from_to(-MAX_LENGTH, MAX_LENGTH);
    /// A length > 0.
    pub const LENGTH: Range = Range::above_to(0.0, MAX_LENGTH);
    /// A length that may be 0.
    pub const LENGTH_OR_ZERO: Range = Range::from_to(0.0, MAX_LENGTH);

    /// Ends included.
    pub const fn from_to(min: f64, max: f64) -> Range {
        Range { min, max, above: false, below: false }
    }

    /// Ends excluded.
    pub const fn between(min: f64, max: f64) -> Range {
        Range { min, max, above: true, below: true }
    }

    /// The lower end excluded.
    pub const fn above_to(min: f64, max: f64) -> Range {
        Range { min, max, above: true, below: false }
    }

    /// The upper end excluded.
    pub const fn from_below(min: f64, max: f64) -> Range {
        Range { min, max, above: false, below: true }
    }

    /// Whether `x` lies in it.
    pub fn contains(&self, x: f64) -> bool {
        (if self.above { x > self.min } else { x >= self.min })
            && (if self.below { x < self.max } else { x <= self.max })
    }

    /// Whether it has a lower end.
    pub fn has_min(&self) -> bool {
        self.min > -f64::MAX
    }

    /// Whether it has an upper end.
    pub fn has_max(&self) -> bool {
        self.max < f64::MAX
    }

    /// " > 0", " in [0, 1]", or nothing.
    pub fn describe(&self) -> String {
        let (low, high) = (show(self.min), show(self.max));
        match (self.has_min(), self.has_max()) {
            (false, false) => String::new(),
            (true, false) => format!(" {} {low}", if self.above { ">" } else { "≥" }),
            (false, true) => format!(" {} {high}", if self.below { "<" } else { "≤" }),
            (true, true) => {
                let (open, close) = (if self.above { '(' } else { '[' }, if self.below { ')' } else { ']' });
                format!(" in {open}{low}, {high}{close}")
            }
        }
    }
}

impl Kind {
    /// What is expected here: "a number > 0".
    pub fn expected(&self) -> String {
        match self {
            Kind::Number(range) => format!("a number{}", range.describe()),
            Kind::Integer(range) => format!("an integer{}", range.describe()),
            Kind::Bool => "true or false".into(),
            Kind::Text => "a string".into(),
            Kind::Name(what) => format!("a string ({what})"),
            Kind::File { what, extensions } => format!("a path to {what} (.{})", extensions.join(", .")),
            Kind::Choice(names) => names.iter().map(|(name, _)| format!("{name:?}")).collect::<Vec<_>>().join(", "),
            Kind::Numbers(numbers) => numbers.expected(),
            Kind::List { what, .. } => format!("a list, each item {what}"),
            Kind::Map { what, .. } => format!("an object of names, each with {what}"),
            Kind::Object(table) => table.expected(),
            Kind::Either(kinds) => alternatives(&kinds.iter().map(|(kind, _)| kind.expected()).collect::<Vec<_>>()),
            Kind::Defined(_, kind) => kind().expected(),
        }
    }
}

impl Table {
    /// What is expected where the object stands.
    pub fn expected(&self) -> String {
        match (self.tag, self.variants.is_empty()) {
            (None, false) => {
                let keys: Vec<&str> = self.variants.iter().map(|(key, _)| *key).collect();
                format!("an object with one of {}", keys.join(", "))
            }
            _ => format!("an object ({})", self.what),
        }
    }
}

impl NumbersKind {
    /// What an item must be.
    pub fn item_kind(&self) -> Kind {
        if self.integer { Kind::Integer(self.item) } else { Kind::Number(self.item) }
    }

    fn expected(&self) -> String {
        let items = match (self.integer, self.null) {
            (true, _) => "integers",
            (_, true) => "numbers or null",
            _ => "numbers",
        };
        let range = self.item.describe();
        match (self.min == self.max, self.multiple_of) {
            (true, _) => format!("a list of {} {items}{range}", self.min),
            (_, 1) => format!("a list of {items}{range}"),
            (_, size) => format!("a flat list of {items}{range}, {size} for each entry"),
        }
    }
}
