//! The kinds of mechanism files, with their names and the verbs of the command line that take them.

use super::entry;
use super::node::{Node, Value};

/// The kind of a mechanism file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// A serial arm at poses of its tool.
    Arm,
    /// A closed loop with numbers for parameters.
    Loop,
    /// A Stewart platform.
    Platform,
    /// Bars and bodies.
    Framework,
    /// Bodies and the joints between them.
    Linkage,
    /// A rational motion.
    Motion,
    /// Positions or pairs of angles for the synthesis of a linkage.
    Synthesis,
    /// A loop with symbols for parameters.
    Conditions,
    /// Displacements with some property.
    Displacement,
    /// Lines and complexes of lines.
    Lines,
    /// Gears and wheels.
    Gearing,
}

impl FileKind {
    /// Returns its name, with its article.
    #[must_use]
    pub const fn noun(self) -> &'static str {
        match self {
            Self::Arm => "an arm",
            Self::Loop => "a loop",
            Self::Platform => "a platform",
            Self::Framework => "a framework",
            Self::Linkage => "a linkage",
            Self::Motion => "a rational motion",
            Self::Synthesis => "a synthesis",
            Self::Conditions => "a loop with symbols",
            Self::Displacement => "a question about displacements",
            Self::Lines => "a question about lines",
            Self::Gearing => "a question about gears",
        }
    }

    /// Returns the verb of the command line that takes it.
    #[must_use]
    pub const fn verb(self) -> &'static str {
        match self {
            Self::Arm
            | Self::Loop
            | Self::Platform
            | Self::Linkage
            | Self::Displacement
            | Self::Lines
            | Self::Gearing => "solve",
            Self::Framework => "mobility",
            Self::Motion => "factor",
            Self::Synthesis => "synthesize",
            Self::Conditions => "conditions",
        }
    }

    /// Returns the message for a file of this kind that should be of another.
    #[must_use]
    pub fn unexpected(self, expected: &str) -> String {
        let (noun, verb) = (self.noun(), self.verb());
        format!("found {noun}, expected {expected}; {noun} is for `looproot {verb}`")
    }

    /// Returns the kind named in a file, with its line, if it is one.
    pub(super) fn of(root: &Node) -> Option<(Self, usize)> {
        if let Some((_, line)) = field(root, "symbols") {
            return Some((Self::Conditions, line));
        }
        let (mechanism, _) = field(root, "mechanism")?;
        let (kind, line) = field(mechanism, "kind")?;
        let Value::Text(word) = &kind.value else { return None };
        let kind = match word.as_str() {
            "arm" => Self::Arm,
            "loop" => Self::Loop,
            "platform" => Self::Platform,
            "framework" => Self::Framework,
            "linkage" => Self::Linkage,
            "motion" => Self::Motion,
            "displacement" => Self::Displacement,
            "lines" => Self::Lines,
            "gearing" => Self::Gearing,
            "synthesis" => Self::Synthesis,
            _ => return None,
        };
        Some((kind, line))
    }
}

impl From<entry::Kind> for FileKind {
    fn from(kind: entry::Kind) -> Self {
        match kind {
            entry::Kind::Arm => Self::Arm,
            entry::Kind::Loop => Self::Loop,
            entry::Kind::Platform => Self::Platform,
        }
    }
}

/// Returns a field of a table and its line.
fn field<'a>(node: &'a Node, key: &str) -> Option<(&'a Node, usize)> {
    let Value::Table(fields) = &node.value else { return None };
    fields.iter().find(|field| field.key == key).map(|field| (&field.node, field.line))
}
