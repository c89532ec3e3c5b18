//! `looproot show`

use super::arguments::ShowOptions;
use super::exit::{Exit, Fault};
use super::output::print;
use looproot::catalogue::{builtin_text, load};
use looproot::error::Error;
use looproot::report::model;

/// Prints a mechanism as it was understood, or the file itself.
pub fn run(options: &ShowOptions) -> Result<Exit, Fault> {
    if options.source {
        print(&source(&options.mechanism)?)?;
        return Ok(Exit::Complete);
    }
    let entry = load(&options.mechanism, &options.read.options())?;
    print(&if options.json { format!("{:#}\n", model::json(&entry)) } else { model::text(&entry) })?;
    Ok(Exit::Complete)
}

/// The text of a file, else of a built-in entry.
fn source(name: &str) -> Result<String, Error> {
    if let (false, Some(text)) = (std::path::Path::new(name).is_file(), builtin_text(name)) {
        return Ok(text.to_owned());
    }
    // Reading it first gives the same errors as everywhere, for names, sizes and bytes.
    if name == "-" {
        return Err(Error::Invalid("standard input is at hand already: --source wants a file or an entry".to_owned()));
    }
    load(name, &looproot::catalogue::Options::default())?;
    std::fs::read_to_string(name).map_err(|error| Error::Io { path: name.to_owned(), message: error.to_string() })
}
