//! Answers as a table of Arrow, which data frames read: a row for each pose, its solutions as a list. The rows are written in batches as
//! they come, so that memory stays flat.

use arrow_array::builder::{
    BooleanBuilder, FixedSizeListBuilder, Float64Builder, Int64Builder, ListBuilder, StringBuilder,
};
use arrow_array::{ArrayRef, RecordBatch};
use arrow_ipc::writer::FileWriter;
use arrow_schema::{ArrowError, DataType, Field, Schema};
use looproot::internal::error::Error;
use looproot::internal::mechanism::Solution;
use std::collections::HashMap;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Rows of a batch: some megabytes of solutions, beyond which a batch is no faster to read.
const ROWS: usize = 4096;

/// The columns of the rows that wait for their batch.
struct Columns {
    q: ListBuilder<FixedSizeListBuilder<Float64Builder>>,
    certified: ListBuilder<BooleanBuilder>,
    near: ListBuilder<BooleanBuilder>,
    within: ListBuilder<BooleanBuilder>,
    status: StringBuilder,
    proof: StringBuilder,
    self_motion: Int64Builder,
    error: StringBuilder,
    rows: usize,
}

impl Columns {
    fn new(joints: i32) -> Self {
        Self {
            q: ListBuilder::new(FixedSizeListBuilder::new(Float64Builder::new(), joints)),
            certified: ListBuilder::new(BooleanBuilder::new()),
            near: ListBuilder::new(BooleanBuilder::new()),
            within: ListBuilder::new(BooleanBuilder::new()),
            status: StringBuilder::new(),
            proof: StringBuilder::new(),
            self_motion: Int64Builder::new(),
            error: StringBuilder::new(),
            rows: 0,
        }
    }

    /// Ends the row of a pose.
    fn end(&mut self, status: &str, proof: &str, self_motion: i64, error: Option<&str>) {
        self.q.append(true);
        self.certified.append(true);
        self.near.append(true);
        self.within.append(true);
        self.status.append_value(status);
        self.proof.append_value(proof);
        self.self_motion.append_value(self_motion);
        self.error.append_option(error);
        self.rows += 1;
    }

    /// Returns the columns of the rows so far, and begins anew.
    fn take(&mut self) -> Vec<ArrayRef> {
        self.rows = 0;
        vec![
            Arc::new(self.q.finish()),
            Arc::new(self.certified.finish()),
            Arc::new(self.near.finish()),
            Arc::new(self.within.finish()),
            Arc::new(self.status.finish()),
            Arc::new(self.proof.finish()),
            Arc::new(self.self_motion.finish()),
            Arc::new(self.error.finish()),
        ]
    }
}

/// A table of answers, as a file of Arrow (Feather 2).
pub struct ArrowTable {
    path: PathBuf,
    columns: Columns,
    schema: Arc<Schema>,
    writer: FileWriter<BufWriter<File>>,
}

impl ArrowTable {
    /// Begins the table of an arm whose joint variables have these names. The names are kept as metadata of the column `q`.
    pub fn create(path: &Path, names: &[String]) -> Result<Self, Error> {
        let joints = i32::try_from(names.len()).unwrap_or(i32::MAX);
        let mut columns = Columns::new(joints);
        // The types of the columns are those that the builders give.
        let types: Vec<DataType> = columns.take().iter().map(|column| column.data_type().clone()).collect();
        let [q, certified, near, within, status, proof, self_motion, error] = &types[..] else {
            return Err(Error::Invalid(format!("found {} columns, expected 8", types.len())));
        };
        let labels = HashMap::from([("names".to_owned(), names.join(","))]);
        let field = |name: &str, kind: &DataType| Field::new(name, kind.clone(), false);
        let schema = Arc::new(Schema::new(vec![
            field("q", q).with_metadata(labels),
            field("certified", certified),
            field("near", near),
            field("within_limits", within),
            field("status", status),
            field("proof", proof),
            field("self_motion", self_motion),
            Field::new("error", error.clone(), true),
        ]));
        let file = File::create(path).map_err(|fault| fault_of(path, &fault.into()))?;
        let writer = FileWriter::try_new(BufWriter::new(file), &schema).map_err(|fault| fault_of(path, &fault))?;
        Ok(Self { path: path.to_owned(), columns, schema, writer })
    }

    /// Adds the answer to the next pose: its real solutions.
    pub fn add(&mut self, solution: &Solution) -> Result<(), Error> {
        let columns = &mut self.columns;
        for mode in solution.modes.iter().filter(|mode| mode.real) {
            let one = columns.q.values();
            mode.q.iter().for_each(|value| one.values().append_value(value.re));
            one.append(true);
            columns.certified.values().append_value(mode.certified);
            columns.near.values().append_value(mode.near);
            if let Some(within) = mode.within_limits {
                columns.within.values().append_value(within);
            }
        }
        let verdict = &solution.verdict;
        let dimension = i64::try_from(verdict.self_motion).unwrap_or(i64::MAX);
        columns.end(verdict.status.word(), verdict.proof.word(), dimension, None);
        self.write_if(ROWS)
    }

    /// Adds a row that is no pose.
    pub fn refuse(&mut self, message: &str) -> Result<(), Error> {
        self.columns.end("error", "none", 0, Some(message));
        self.write_if(ROWS)
    }

    /// Writes the rows that wait and the end of the file.
    pub fn close(mut self) -> Result<(), Error> {
        self.write_if(1)?;
        let end = |writer: &mut FileWriter<BufWriter<File>>| {
            writer.finish()?;
            writer.get_mut().flush().map_err(ArrowError::from)
        };
        end(&mut self.writer).map_err(|fault| fault_of(&self.path, &fault))
    }

    /// Writes the rows that wait, if there are this many.
    fn write_if(&mut self, enough: usize) -> Result<(), Error> {
        if self.columns.rows < enough {
            return Ok(());
        }
        RecordBatch::try_new(self.schema.clone(), self.columns.take())
            .and_then(|batch| self.writer.write(&batch))
            .map_err(|fault| fault_of(&self.path, &fault))
    }
}

fn fault_of(path: &Path, fault: &ArrowError) -> Error {
    Error::Io { path: path.display().to_string(), message: fault.to_string() }
}
