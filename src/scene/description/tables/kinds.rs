//! The vocabulary of the tables: what a key's value can be.

use super::super::json::show;

/// One key of an object.
#[derive(Debug)]
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

/// A required key.
pub const fn required(key: &'static str, kind: Kind, doc: &'static str) -> Field {
    Field { key, kind, need: Need::Required, doc }
}

/// A key that may be absent.
pub const fn optional(key: &'static str, kind: Kind, doc: &'static str) -> Field {
    Field { key, kind, need: Need::Optional, doc }
}

/// A key with a default, as JSON text.
pub const fn default(key: &'static str, kind: Kind, json: &'static str, doc: &'static str) -> Field {
    Field { key, kind, need: Need::Default(json), doc }
}

/// What a value can be.
#[derive(Debug, Clone, Copy)]
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
    /// A path to a file of one of these kinds.
    File(&'static FileKind),
    /// One of a set of strings.
    Choice(&'static Choice),
    /// A list of nothing but numbers.
    Numbers(Numbers),
    /// A list of anything else.
    List(&'static List),
    /// An object whose keys are the user's names.
    Map(&'static Map),
    /// An object with known keys.
    Object(&'static Table),
    /// An object whose keys depend on one of them.
    Tagged(&'static Tagged),
    /// An object recognised by its keys.
    Forms(&'static Forms),
    /// A spectrum ([`super::SPECTRUM`]) in a role.
    Spectrum(Role),
    /// One of several kinds that differ in their JSON type.
    Either(&'static [Kind]),
}

/// Kinds of file, by extension.
#[derive(Debug)]
pub struct FileKind {
    /// What the file holds.
    pub what: &'static str,
    /// Extensions that are read, without the dot.
    pub extensions: &'static [&'static str],
    /// Extensions that will be.
    pub later: &'static [&'static str],
}

/// A set of strings.
#[derive(Debug)]
pub struct Choice {
    /// What is chosen.
    pub what: &'static str,
    /// The names with their meaning.
    pub names: &'static [(&'static str, &'static str)],
    /// Names that will come.
    pub later: &'static [&'static str],
}

/// A list of numbers.
#[derive(Debug, Clone, Copy)]
pub struct Numbers {
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

impl Numbers {
    /// Exactly `count` numbers.
    pub const fn exactly(count: usize, item: Range) -> Numbers {
        Numbers { min: count, max: count, multiple_of: 1, item, integer: false, null: false }
    }

    /// From `min` to `max` numbers.
    pub const fn several(min: usize, max: usize, item: Range) -> Numbers {
        Numbers { min, max, multiple_of: 1, item, integer: false, null: false }
    }

    /// A flat list of tuples of `size` numbers, at least one tuple.
    pub const fn tuples(size: usize, item: Range) -> Numbers {
        Numbers { min: size, max: usize::MAX, multiple_of: size, item, integer: false, null: false }
    }
}

/// A list of objects.
#[derive(Debug)]
pub struct List {
    /// What an item is called.
    pub what: &'static str,
    /// The items.
    pub item: Kind,
    /// Fewest items.
    pub min: usize,
    /// Most items.
    pub max: usize,
}

/// An object whose keys are the user's names.
#[derive(Debug)]
pub struct Map {
    /// What an entry is called.
    pub what: &'static str,
    /// The entries.
    pub item: Kind,
}

/// Most entries of a [`Map`].
pub const MAX_NAMES: usize = 100_000;

/// Longest string, bytes.
pub const MAX_TEXT: usize = 4096;

/// An object with known keys. `"comment"` is always allowed.
#[derive(Debug)]
pub struct Table {
    /// With its article: "a sphere".
    pub what: &'static str,
    /// What it is.
    pub doc: &'static str,
    /// Its keys.
    pub fields: &'static [Field],
    /// Keys shared with other tables.
    pub common: &'static [Field],
    /// What holds between keys.
    pub rule: Rule,
    /// Keys that will come.
    pub later: &'static [&'static str],
}

impl Table {
    /// All keys but those that every object may have.
    pub fn all_fields(&self) -> impl Iterator<Item = &'static Field> + Clone {
        self.fields.iter().chain(self.common)
    }

    /// The field of a key.
    pub fn field(&self, key: &str) -> Option<&'static Field> {
        self.all_fields().find(|field| field.key == key)
    }
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

/// An object whose keys depend on the string under `tag`.
#[derive(Debug)]
pub struct Tagged {
    /// With its article: "a shape".
    pub what: &'static str,
    /// The key that tells: "type".
    pub tag: &'static str,
    /// The kinds.
    pub variants: &'static [(&'static str, Body)],
    /// Kinds that will come.
    pub later: &'static [&'static str],
}

/// The keys of one kind of a [`Tagged`].
#[derive(Debug)]
pub enum Body {
    /// These.
    Table(&'static Table),
    /// Those that depend on a second tag.
    Tagged(&'static Tagged),
}

/// An object recognised by its keys, with shorthands.
#[derive(Debug)]
pub struct Forms {
    /// With its article: "a spectrum".
    pub what: &'static str,
    /// What a bare number means, and its range.
    pub number: Option<(&'static str, Range)>,
    /// What a bare string means.
    pub text: Option<&'static str>,
    /// The forms; no two share a key, except the common ones.
    pub forms: &'static [&'static Table],
}

impl Forms {
    /// The form that owns a key.
    pub fn owner(&self, key: &str) -> Option<&'static Table> {
        self.forms.iter().copied().find(|form| form.fields.iter().any(|field| field.key == key))
    }
}

/// What a spectrum stands for, which decides its range and how RGB is upsampled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Not known yet: an entry of `spectra`.
    Named,
    /// A fraction of light.
    Reflectance,
    /// Radiance, intensity, irradiance or power.
    Emission,
    /// An absorption coefficient, per metre.
    Absorption,
    /// A part of a complex index.
    Index,
}

impl Role {
    /// With its article, for messages.
    pub fn what(self) -> &'static str {
        match self {
            Role::Named => "a spectrum",
            Role::Reflectance => "a reflectance",
            Role::Emission => "an emission",
            Role::Absorption => "an absorption",
            Role::Index => "a complex index",
        }
    }

    /// The values it may have.
    pub fn range(self) -> Range {
        match self {
            Role::Named => Range::ANY,
            Role::Reflectance => Range::FRACTION,
            Role::Emission | Role::Absorption | Role::Index => Range::NOT_NEGATIVE,
        }
    }

    /// Whether an RGB colour can stand here.
    pub fn takes_rgb(self) -> bool {
        !matches!(self, Role::Absorption | Role::Index)
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
pub const MAX_LENGTH: f64 = 1e30;

impl Range {
    /// Every finite number.
    pub const ANY: Range = Range::from_to(-f64::MAX, f64::MAX);
    /// x ≥ 0.
    pub const NOT_NEGATIVE: Range = Range::from_to(0.0, f64::MAX);
    /// x > 0.
    pub const POSITIVE: Range = Range { above: true, ..Range::NOT_NEGATIVE };
    /// [0, 1].
    pub const FRACTION: Range = Range::from_to(0.0, 1.0);
    /// A coordinate.
    pub const COORDINATE: Range = Range::from_to(-MAX_LENGTH, MAX_LENGTH);
    /// A length > 0.
    pub const LENGTH: Range = Range { above: true, ..Range::from_to(0.0, MAX_LENGTH) };
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
            Kind::File(file) => file.expected(),
            Kind::Choice(choice) => choice.expected(),
            Kind::Numbers(numbers) => numbers.expected(),
            Kind::List(list) => format!("a list, each item {}", list.what),
            Kind::Map(map) => format!("an object of names, each with {}", map.what),
            Kind::Object(table) => format!("an object ({})", table.what),
            Kind::Tagged(tagged) => format!("an object ({})", tagged.what),
            Kind::Forms(forms) => forms.expected(),
            Kind::Spectrum(_) => super::SPECTRUM.expected(),
            Kind::Either(kinds) => kinds.iter().map(Kind::expected).collect::<Vec<_>>().join(" or "),
        }
    }
}

impl FileKind {
    /// "a path to a mesh (.obj, .ply)".
    pub fn expected(&self) -> String {
        format!("a path to {} (.{})", self.what, self.extensions.join(", ."))
    }
}

impl Choice {
    /// The names, quoted.
    pub fn expected(&self) -> String {
        let names: Vec<String> = self.names.iter().map(|(name, _)| format!("{name:?}")).collect();
        names.join(", ")
    }
}

impl Numbers {
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

impl Forms {
    /// "a number, a name, or an object with one of …".
    pub fn expected(&self) -> String {
        let keys: Vec<&str> = self.forms.iter().map(|form| form.fields[0].key).collect();
        let mut text = String::from(if self.number.is_some() { "a number, " } else { "" });
        text.push_str(if self.text.is_some() { "a name, or " } else { "" });
        format!("{text}an object with one of {}", keys.join(", "))
    }
}
