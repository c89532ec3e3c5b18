//! Tables for a terminal: aligned numbers under one line, no boxes.

use comfy_table::{Cell, CellAlignment, ContentArrangement, LineStyle, Table, TableStyle};

const STYLE: TableStyle = TableStyle::new().header_separator(LineStyle::none().fill('─'));

/// A table with this header; columns named in `words` hold words and stand left, the others hold numbers.
///
/// # Example
/// ```
/// let mut table = looproot::internal::report::table::Columns::new(&["name", "roots"], &["name"]);
/// table.row(["puma560", "8"]);
/// assert!(table.text().lines().last().unwrap().trim_start().starts_with("puma560"));
/// ```
pub struct Columns {
    table: Table,
    left: Vec<bool>,
}

impl Columns {
    /// An empty table.
    #[must_use]
    pub fn new<S: AsRef<str>>(header: &[S], words: &[&str]) -> Self {
        let mut table = Table::new();
        table.load_style(STYLE).set_content_arrangement(ContentArrangement::Disabled);
        let left: Vec<bool> = header.iter().map(|name| words.contains(&name.as_ref())).collect();
        let cells = header.iter().zip(&left).map(|(name, left)| cell(name.as_ref(), *left));
        table.set_header(cells.collect::<Vec<_>>());
        Self { table, left }
    }

    /// Adds a row of one cell for every column.
    pub fn row<S: AsRef<str>>(&mut self, cells: impl IntoIterator<Item = S>) {
        let cells = cells.into_iter().zip(&self.left).map(|(text, left)| cell(text.as_ref(), *left));
        self.table.add_row(cells.collect::<Vec<_>>());
    }

    /// The table, every line ended.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = String::new();
        for line in self.table.lines() {
            text.push_str(line.trim_end());
            text.push('\n');
        }
        text
    }
}

fn cell(text: &str, left: bool) -> Cell {
    Cell::new(text).set_alignment(if left { CellAlignment::Left } else { CellAlignment::Right })
}

/// Appends words in lines of at most 100 characters, those after the first indented.
pub fn paragraph(text: &mut String, words: &str) {
    let mut width = 0;
    for word in words.split_whitespace() {
        let length = word.chars().count();
        if width > 0 && width + 1 + length > 100 {
            text.push_str("\n  ");
            width = 2;
        } else if width > 0 {
            text.push(' ');
            width += 1;
        }
        text.push_str(word);
        width += length;
    }
    text.push('\n');
}
