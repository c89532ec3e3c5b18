//! The poses of `--poses`, read row by row while others are solved.

use super::npy::{Array, MAGIC, Numbers};
use looproot::internal::catalogue::entry::{Case, Design};
use looproot::internal::catalogue::poses::PoseRows;
use looproot::internal::error::Error;
use looproot_algebra::number::Reading;
use std::fs::File;
use std::io::{BufRead, BufReader, Read};

/// Maximum length of a row, bytes: a pose of twelve numbers of sixty digits has less than a thousand.
const LONGEST: u64 = 1 << 16;

/// A row of a table of poses.
pub struct Row {
    /// Its line, from 1.
    pub line: usize,
    /// Its content, or the reason why there is none.
    content: Result<Content, Error>,
}

/// The content of a row.
enum Content {
    Text(String),
    Doubles(Numbers),
}

/// The rows of a table that are not empty, in their order.
pub struct Rows<'a> {
    path: &'a str,
    input: Box<dyn BufRead + Send>,
    line: usize,
    /// A row that was read to determine the form of the table.
    first: Option<Row>,
    /// The array that the file is, where it is none of text.
    array: Option<Array>,
}

/// Opens a table of poses, or standard input.
pub fn open<'a>(path: &'a str, design: &'a Design, reading: &Reading) -> Result<(PoseRows<'a>, Rows<'a>), Error> {
    let mut input: Box<dyn BufRead + Send> = if path == "-" {
        Box::new(BufReader::new(std::io::stdin()))
    } else {
        let file = File::open(path).map_err(|fault| Error::Io { path: path.to_owned(), message: fault.to_string() })?;
        Box::new(BufReader::with_capacity(1 << 20, file))
    };
    let begin = input.fill_buf().map_err(|fault| Error::Io { path: path.to_owned(), message: fault.to_string() })?;
    if begin.starts_with(MAGIC) {
        let array = Array::open(&mut input).map_err(|fault| fault.at(path, 1))?;
        let (reader, _) = PoseRows::of(array.header(), 1, path, design, reading)?;
        return Ok((reader.of_doubles(), Rows { path, input, line: 0, first: None, array: Some(array) }));
    }
    let mut rows = Rows { path, input, line: 0, first: None, array: None };
    let Some(first) = rows.next() else {
        return Err(Error::Invalid("found no rows, expected a table of poses".to_owned()).at(path, 1));
    };
    let Row { line, content } = first;
    let content = content?;
    let text = if let Content::Text(text) = &content { text.as_str() } else { "" };
    let (reader, is_row) = PoseRows::of(text, line, path, design, reading)?;
    rows.first = is_row.then_some(Row { line, content: Ok(content) });
    Ok((reader, rows))
}

impl Iterator for Rows<'_> {
    type Item = Row;

    fn next(&mut self) -> Option<Row> {
        if let Some(first) = self.first.take() {
            return Some(first);
        }
        if let Some(array) = &self.array {
            if self.line >= array.count {
                return None;
            }
            self.line += 1;
            let line = self.line;
            let content = array.row(line, &mut self.input).map_err(|fault| fault.at(self.path, line));
            // What a file ends before is missed once.
            if content.is_err() && self.input.fill_buf().is_ok_and(<[u8]>::is_empty) {
                self.line = array.count;
            }
            return Some(Row { line, content: content.map(Content::Doubles) });
        }
        loop {
            let mut bytes = Vec::new();
            let read = self.input.by_ref().take(LONGEST).read_until(b'\n', &mut bytes);
            self.line += 1;
            let line = self.line;
            match read {
                Ok(0) => return None,
                Err(fault) => {
                    let fault = Error::Io { path: self.path.to_owned(), message: fault.to_string() };
                    return Some(Row { line, content: Err(fault) });
                }
                Ok(_) => {}
            }
            let is_whole = bytes.ends_with(b"\n") || (bytes.len() as u64) < LONGEST;
            if !is_whole && !self.skip_line() {
                return None;
            }
            let fault = |message: &str| Error::Invalid(message.to_owned()).at(self.path, line);
            let text = if is_whole {
                String::from_utf8(bytes).map_err(|_| fault("found bytes that are not UTF-8, expected text"))
            } else {
                Err(fault("found a row of more than 64 KiB, expected a pose"))
            };
            if text.as_ref().is_ok_and(|text| text.trim().is_empty()) {
                continue;
            }
            return Some(Row { line, content: text.map(Content::Text) });
        }
    }
}

impl Rows<'_> {
    /// Reads on to the end of the line; returns `false` if the input cannot be read.
    fn skip_line(&mut self) -> bool {
        loop {
            let Ok(buffer) = self.input.fill_buf() else { return false };
            if buffer.is_empty() {
                return true;
            }
            let end = buffer.iter().position(|byte| *byte == b'\n');
            let (length, is_end) = (end.map_or(buffer.len(), |at| at + 1), end.is_some());
            self.input.consume(length);
            if is_end {
                return true;
            }
        }
    }
}

impl Row {
    /// Returns the pose of the row.
    pub fn case(&self, reader: &PoseRows<'_>) -> Result<Case, Error> {
        match self.content.as_ref().map_err(Clone::clone)? {
            Content::Text(text) => reader.case(text, self.line),
            Content::Doubles((row, count)) => reader.case_of_doubles(&row[..*count], self.line),
        }
    }
}
