//! The common form of TOML and JSON: values with their line, numbers with their text.

use crate::algebra::sort;
use crate::error::{Error, Result};
use jsonc_parser::ast;
use std::collections::HashSet;
use toml::de::{DeTable, DeValue};

/// Deepest nesting of tables and lists read: far beyond any mechanism, far within the stack.
const DEEPEST: usize = 64;

/// A value and the line of the file at which it begins.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub(super) line: usize,
    pub(super) value: Value,
}

/// A value of a file.
#[derive(Clone, Debug)]
pub(super) enum Value {
    /// A number, as it was written.
    Number(String),
    Text(String),
    List(Vec<Node>),
    Table(Vec<Field>),
    /// A value that no mechanism file has, by its name.
    Other(&'static str),
}

/// A key with its value.
#[derive(Clone, Debug)]
pub(super) struct Field {
    pub(super) key: String,
    pub(super) line: usize,
    pub(super) node: Node,
}

impl Node {
    /// Returns the kind of value, for messages.
    pub(super) fn describe(&self) -> String {
        match &self.value {
            Value::Number(text) => format!("the number {}", text.chars().take(40).collect::<String>()),
            Value::Text(text) => format!("the string \"{}\"", text.chars().take(40).collect::<String>()),
            Value::List(items) => format!("a list of {}", items.len()),
            Value::Table(_) => "a table".to_owned(),
            Value::Other(name) => (*name).to_owned(),
        }
    }
}

/// Line numbers of byte offsets.
pub(super) struct Lines(Vec<usize>);

impl Lines {
    pub(super) fn new(text: &str) -> Self {
        Self(text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n').map(|(at, _)| at).collect())
    }

    /// Returns the line of a byte offset, from 1.
    pub(super) fn at(&self, offset: usize) -> usize {
        self.0.partition_point(|newline| *newline < offset) + 1
    }
}

/// Reads TOML.
pub(super) fn from_toml(text: &str, path: &str) -> Result<Node> {
    check_depth(text, path)?;
    let lines = Lines::new(text);
    let table = DeTable::parse(text).map_err(|fault| {
        let line = fault.span().map_or(1, |span| lines.at(span.start.min(text.len().saturating_sub(1))));
        let message = format!("found text that is not TOML: {}", fault.message());
        Error::File { path: path.to_owned(), line, message }
    })?;
    Ok(Node { line: 1, value: toml_table(table.get_ref(), &lines) })
}

fn toml_table(table: &DeTable<'_>, lines: &Lines) -> Value {
    // In the order of the file, several keys on one line included.
    let mut pairs: Vec<_> = table.iter().collect();
    sort::by_key(&mut pairs, |(key, _)| key.span().start);
    let field = |(key, value): &(&_, &toml::Spanned<DeValue<'_>>)| {
        let key: &toml::Spanned<std::borrow::Cow<'_, str>> = key;
        Field {
            key: key.get_ref().to_string(),
            line: lines.at(key.span().start),
            node: toml_node(value.get_ref(), lines.at(value.span().start), lines),
        }
    };
    Value::Table(pairs.iter().map(field).collect())
}

fn toml_node(value: &DeValue<'_>, line: usize, lines: &Lines) -> Node {
    let value = match value {
        DeValue::String(text) => Value::Text(text.to_string()),
        DeValue::Integer(integer) if integer.radix() == 10 => Value::Number(integer.as_str().to_owned()),
        DeValue::Integer(integer) => match i128::from_str_radix(integer.as_str(), integer.radix()) {
            Ok(decimal) => Value::Number(decimal.to_string()),
            Err(_) => Value::Other("an integer too large to read"),
        },
        DeValue::Float(float) => Value::Number(float.as_str().to_owned()),
        DeValue::Boolean(_) => Value::Other("a truth value"),
        DeValue::Datetime(_) => Value::Other("a date"),
        DeValue::Array(items) => Value::List(
            items.iter().map(|item| toml_node(item.get_ref(), lines.at(item.span().start), lines)).collect(),
        ),
        DeValue::Table(table) => toml_table(table, lines),
    };
    Node { line, value }
}

/// Reads strict JSON: no comments, no trailing commas.
pub(super) fn from_json(text: &str, path: &str) -> Result<Node> {
    check_depth(text, path)?;
    let lines = Lines::new(text);
    let strict = jsonc_parser::ParseOptions {
        allow_comments: false,
        allow_loose_object_property_names: false,
        allow_trailing_commas: false,
        allow_missing_commas: false,
        allow_single_quoted_strings: false,
        allow_hexadecimal_numbers: false,
        allow_unary_plus_numbers: false,
    };
    let parsed = jsonc_parser::parse_to_ast(text, &jsonc_parser::CollectOptions::default(), &strict);
    let parsed = parsed.map_err(|fault| {
        let line = lines.at(fault.range().start);
        let message = format!("found text that is not JSON: {}", fault.kind());
        Error::File { path: path.to_owned(), line, message }
    })?;
    let Some(value) = parsed.value else {
        return Err(Error::File { path: path.to_owned(), line: 1, message: "found no JSON value".to_owned() });
    };
    json_node(&value, &lines, path)
}

fn json_node(value: &ast::Value<'_>, lines: &Lines, path: &str) -> Result<Node> {
    let (start, value) = match value {
        ast::Value::StringLit(text) => (text.range.start, Value::Text(text.value.to_string())),
        ast::Value::NumberLit(number) => (number.range.start, Value::Number(number.value.to_owned())),
        ast::Value::BooleanLit(truth) => (truth.range.start, Value::Other("a truth value")),
        ast::Value::NullKeyword(null) => (null.range.start, Value::Other("null")),
        ast::Value::Array(array) => {
            let items = array.elements.iter().map(|item| json_node(item, lines, path));
            (array.range.start, Value::List(items.collect::<Result<_>>()?))
        }
        ast::Value::Object(object) => {
            let mut fields: Vec<Field> = Vec::new();
            let mut keys = HashSet::new();
            for property in &object.properties {
                let (key, line) = (property.name.as_str().to_owned(), lines.at(property.range.start));
                if !keys.insert(key.clone()) {
                    let message = format!("found the key `{key}` twice, expected it once");
                    return Err(Error::File { path: path.to_owned(), line, message });
                }
                fields.push(Field { key, line, node: json_node(&property.value, lines, path)? });
            }
            (object.range.start, Value::Table(fields))
        }
    };
    Ok(Node { line: lines.at(start), value })
}

/// Refuses deep nesting before a recursive reader meets it: brackets, and dotted TOML keys, which nest as well.
/// Brackets in strings are counted, too; strings with that many unbalanced ones do not occur.
fn check_depth(text: &str, path: &str) -> Result<()> {
    let (mut brackets, mut dots, mut after_key) = (0_usize, 0_usize, false);
    for (at, byte) in text.bytes().enumerate() {
        match byte {
            b'[' | b'{' => brackets += 1,
            b']' | b'}' => brackets = brackets.saturating_sub(1),
            _ => {}
        }
        match byte {
            b'.' if after_key => (dots, after_key) = (dots + 1, false),
            b' ' | b'\t' => {}
            b'"' | b'\'' | b'-' | b'_' => after_key = true,
            _ if byte.is_ascii_alphanumeric() => after_key = true,
            _ => (dots, after_key) = (0, false),
        }
        if brackets > DEEPEST || dots > DEEPEST {
            let message = format!("found tables or lists nested deeper than {DEEPEST}");
            return Err(Error::File { path: path.to_owned(), line: Lines::new(text).at(at), message });
        }
    }
    Ok(())
}
