//! `looproot show`

use super::arguments::ShowOptions;
use super::exit::{Exit, Fault};
use super::output::print;
use looproot::internal::catalogue::{Options, builtin_text, load_any, namesakes};
use looproot::internal::error::Error;
use looproot::internal::report::model;
use std::path::Path;

/// Prints a mechanism as it was understood, or the file itself.
pub fn run(options: &ShowOptions) -> Result<Exit, Fault> {
    let namesakes = namesakes(&options.mechanism);
    if let ([_, _, ..], false) = (namesakes.as_slice(), Path::new(&options.mechanism).is_file()) {
        let message = format!("found the name `{}`, expected one of {}", options.mechanism, namesakes.join(", "));
        return Err(Error::Invalid(message).into());
    }
    if options.source {
        print(&source(&options.mechanism)?)?;
        return Ok(Exit::Complete);
    }
    let any = load_any(&options.mechanism, &options.read.options())?;
    print(&if options.json { format!("{:#}\n", model::any_json(&any)) } else { model::any_text(&any) })?;
    Ok(Exit::Complete)
}

/// Returns the text of a file, else of a built-in entry.
fn source(name: &str) -> Result<String, Error> {
    if let (false, Some(text)) = (Path::new(name).is_file(), builtin_text(name)) {
        return Ok(text.to_owned());
    }
    // Reading it first gives the usual errors about names, sizes and bytes.
    if name == "-" {
        return Err(Error::Invalid("standard input is at hand already: --source wants a file or an entry".to_owned()));
    }
    load_any(name, &Options::default())?;
    std::fs::read_to_string(name).map_err(|error| Error::Io { path: name.to_owned(), message: error.to_string() })
}
