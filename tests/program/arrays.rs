//! Poses from an array of numpy, and answers as arrays or as a table of Arrow: the same as those of a table as JSON lines.
#![allow(clippy::unwrap_used)]

use arrow_array::cast::AsArray;
use arrow_array::types::{Float64Type, Int64Type};
use arrow_array::{Array, RecordBatch};
use arrow_ipc::reader::FileReader;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::Read;
use std::path::PathBuf;
use std::process::{Command, Output};

/// Poses that the arm `ur5` reaches, one that it does not reach, and one that is none: x, y, z, qw, qx, qy, qz.
const POSES: [[f64; 7]; 4] = [
    [0.4, 0.1, 0.3, 0.0, 1.0, 0.0, 0.0],
    [0.3, -0.2, 0.4, 0.5, 0.5, 0.5, 0.5],
    [5.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
    [0.4, 0.1, 0.3, 0.0, 3.0, 0.0, 0.0],
];

/// A place for files of this test.
fn place(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("arrays");
    fs::create_dir_all(&folder).unwrap();
    folder.join(name)
}

fn run(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_looproot")).args(arguments).output().unwrap()
}

/// A file of numpy with this shape.
fn npy(name: &str, kind: &str, shape: &str, bytes: &[u8]) -> String {
    let head = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}\n");
    let mut all = b"\x93NUMPY\x01\x00".to_vec();
    all.extend(u16::try_from(head.len()).unwrap().to_le_bytes());
    all.extend(head.bytes());
    all.extend(bytes);
    let path = place(name);
    fs::write(&path, all).unwrap();
    path.display().to_string()
}

fn doubles(values: impl IntoIterator<Item = f64>) -> Vec<u8> {
    values.into_iter().flat_map(f64::to_le_bytes).collect()
}

/// The matrix of a pose whose quaternion has norm 1.
fn matrix([x, y, z, w, a, b, c]: [f64; 7]) -> [f64; 16] {
    [
        1.0 - 2.0 * (b * b + c * c),
        2.0 * (a * b - w * c),
        2.0 * (a * c + w * b),
        x,
        2.0 * (a * b + w * c),
        1.0 - 2.0 * (a * a + c * c),
        2.0 * (b * c - w * a),
        y,
        2.0 * (a * c - w * b),
        2.0 * (b * c + w * a),
        1.0 - 2.0 * (a * a + b * b),
        z,
        0.0,
        0.0,
        0.0,
        1.0,
    ]
}

/// The results of JSON lines.
fn lines(output: &Output) -> Vec<Value> {
    String::from_utf8(output.stdout.clone()).unwrap().lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// The arrays of a file: their heads and their bytes.
fn arrays(path: &str) -> BTreeMap<String, (String, Vec<u8>)> {
    let mut archive = zip::ZipArchive::new(File::open(path).unwrap()).unwrap();
    let count = archive.len();
    let one = |index| {
        let mut file = archive.by_index(index).unwrap();
        let name = file.name().unwrap().trim_end_matches(".npy").to_owned();
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).unwrap();
        let begin = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
        assert_eq!((&bytes[..6], begin % 64), (&b"\x93NUMPY"[..], 0), "{name}");
        (name, (String::from_utf8_lossy(&bytes[10..begin]).into_owned(), bytes.split_off(begin)))
    };
    (0..count).map(one).collect()
}

#[test]
fn arrays_of_both_shapes_are_answered_as_tables_are() {
    let header = "x_m,y_m,z_m,qw,qx,qy,qz\n".to_owned();
    let table = POSES.iter().fold(header, |text, pose| text + &pose.map(|value| value.to_string()).join(",") + "\n");
    let csv = place("poses.csv");
    fs::write(&csv, table).unwrap();
    let by_table = run(&["solve", "ur5", "--poses", &csv.display().to_string(), "--jsonl", "--seed", "1"]);
    let rows = npy("rows.npy", "<f8", "(4, 7)", &doubles(POSES.concat()));
    let by_rows = run(&["solve", "ur5", "--poses", &rows, "--jsonl", "--seed", "1"]);
    assert_eq!((by_rows.status.code(), by_table.status.code()), (Some(1), Some(1)));
    let (table, rows) = (lines(&by_table), lines(&by_rows));
    assert_eq!((table.len(), rows.len()), (4, 4));
    for (table, row) in table.iter().zip(&rows).take(3) {
        assert_eq!(table["modes"], row["modes"]);
    }
    assert!(rows[3]["error"]["message"].as_str().unwrap().contains("norm 3"), "{}", rows[3]);
    let whole: Vec<f64> = POSES[..3].iter().flat_map(|pose| matrix(*pose)).collect();
    let matrices = npy("matrices.npy", "<f8", "(3, 4, 4)", &doubles(whole));
    for (table, row) in table.iter().zip(lines(&run(&["solve", "ur5", "--poses", &matrices, "--jsonl"]))) {
        assert_eq!(table["verdict"]["real"], row["verdict"]["real"]);
    }
}

#[test]
fn answers_as_arrays_are_those_of_json_lines() {
    let rows = npy("asked.npy", "<f8", "(4, 7)", &doubles(POSES.concat()));
    let expected = lines(&run(&["solve", "ur5", "--poses", &rows, "--jsonl", "--seed", "1"]));
    let out = place("answers.npz").display().to_string();
    let output = run(&["solve", "ur5", "--poses", &rows, "--seed", "1", "-o", &out]);
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stdout).contains("3 poses and 1 row without a pose"));
    let found = arrays(&out);
    let whole = |name: &str| -> Vec<i64> {
        found[name].1.chunks_exact(8).map(|part| i64::from_le_bytes(part.try_into().unwrap())).collect()
    };
    let text = |name: &str, width: usize| -> Vec<String> {
        let letter = |part: &[u8]| char::from_u32(u32::from_le_bytes(part.try_into().unwrap())).unwrap();
        let word = |part: &[u8]| part.chunks_exact(4).map(letter).filter(|letter| *letter != '\0').collect();
        found[name].1.chunks_exact(4 * width).map(word).collect()
    };
    let modes: Vec<&Value> = expected.iter().filter_map(|result| result["modes"].as_array()).flatten().collect();
    let q: Vec<f64> = found["q"].1.chunks_exact(8).map(|part| f64::from_le_bytes(part.try_into().unwrap())).collect();
    let wanted: Vec<f64> = modes
        .iter()
        .flat_map(|mode| mode["q"].as_array().unwrap().iter().map(|value| value.as_f64().unwrap()))
        .collect();
    // The reader of JSON is off by a unit in the last place here and there.
    assert_eq!(q.len(), wanted.len());
    assert!(q.iter().zip(&wanted).all(|(one, other)| (one - other).abs() <= f64::EPSILON * other.abs()));
    assert!(found["q"].0.contains(&format!("'shape': ({}, 6,)", modes.len())), "{}", found["q"].0);
    let mut offsets = vec![0];
    for result in &expected {
        let count = result["modes"].as_array().map_or(0, Vec::len);
        offsets.push(offsets[offsets.len() - 1] + i64::try_from(count).unwrap());
    }
    assert_eq!(whole("offsets"), offsets);
    assert_eq!(text("status", 12), ["complete", "complete", "unreachable", "error"]);
    assert_eq!(text("proof", 12), ["proved", "proved", "proved", "none"]);
    assert_eq!(whole("failed"), [3]);
    assert_eq!(text("names", 2), ["q1", "q2", "q3", "q4", "q5", "q6"]);
    assert_eq!(found["certified"].1, vec![1; modes.len()]);
    assert!(found["has_limits"].0.contains("'shape': ()"));
    // Nothing is left beside the answer.
    let left = fs::read_dir(place(""))
        .unwrap()
        .filter(|file| file.as_ref().unwrap().file_name().to_string_lossy().ends_with(".part"));
    assert_eq!(left.count(), 0);
}

#[test]
fn a_table_of_arrow_holds_the_answers_of_json_lines() {
    let rows = npy("framed.npy", "<f8", "(4, 7)", &doubles(POSES.concat()));
    let expected = lines(&run(&["solve", "ur5", "--poses", &rows, "--jsonl", "--seed", "1"]));
    let out = place("answers.arrow").display().to_string();
    let output = run(&["solve", "ur5", "--poses", &rows, "--seed", "1", "-o", &out]);
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stdout).contains("3 poses and 1 row without a pose"));
    let reader = FileReader::try_new(File::open(&out).unwrap(), None).unwrap();
    let batches: Vec<RecordBatch> = reader.map(Result::unwrap).collect();
    assert_eq!(batches.len(), 1);
    let table = &batches[0];
    assert_eq!(table.schema().field_with_name("q").unwrap().metadata()["names"], "q1,q2,q3,q4,q5,q6");
    let text = |name: &str| -> Vec<Option<String>> {
        table.column_by_name(name).unwrap().as_string::<i32>().iter().map(|word| word.map(str::to_owned)).collect()
    };
    let words = |words: [&str; 4]| words.map(|word| Some(word.to_owned())).to_vec();
    assert_eq!(text("status"), words(["complete", "complete", "unreachable", "error"]));
    assert_eq!(text("proof"), words(["proved", "proved", "proved", "none"]));
    assert!(text("error")[3].as_ref().unwrap().contains("norm 3"));
    assert_eq!(text("error")[..3], [None, None, None]);
    let of = |name: &str| table.column_by_name(name).unwrap();
    assert_eq!(of("self_motion").as_primitive::<Int64Type>().values()[..], [0; 4]);
    let (q, certified) = (of("q").as_list::<i32>(), of("certified").as_list::<i32>());
    for (row, result) in expected.iter().enumerate() {
        let modes = result["modes"].as_array().map_or(&[][..], Vec::as_slice);
        let found = q.value(row);
        let found = found.as_fixed_size_list();
        assert_eq!((found.len(), certified.value(row).as_boolean().true_count()), (modes.len(), modes.len()));
        let found = found.values().as_primitive::<Float64Type>().values().to_vec();
        let wanted = modes.iter().flat_map(|mode| mode["q"].as_array().unwrap()).map(|value| value.as_f64().unwrap());
        // The reader of JSON is off by a unit in the last place here and there.
        assert!(found.iter().zip(wanted).all(|(one, other)| (one - other).abs() <= f64::EPSILON * other.abs()));
    }
}

#[test]
fn a_long_table_of_arrow_is_written_in_batches() {
    // Rows that are no poses take no time.
    let rows = npy("long.npy", "<f8", "(5000, 7)", &doubles(POSES[3].repeat(5000)));
    let out = place("long.arrow").display().to_string();
    run(&["solve", "ur5", "--poses", &rows, "--quiet", "-o", &out]);
    let reader = FileReader::try_new(File::open(&out).unwrap(), None).unwrap();
    let counts: Vec<usize> = reader.map(|batch| batch.unwrap().num_rows()).collect();
    assert_eq!(counts, [4096, 904]);
}

#[test]
fn arrays_of_another_shape_are_refused_by_what_was_found() {
    let message = |path: &str, more: &[&str]| {
        let output = run(&[&["solve", "ur5", "--poses", path], more].concat());
        assert_eq!(output.status.code(), Some(1));
        String::from_utf8(output.stderr).unwrap()
    };
    let square = npy("square.npy", "<f8", "(4, 4)", &doubles([0.0; 16]));
    let text = message(&square, &[]);
    assert!(text.contains("square.npy:1: found the shape (4, 4), expected the shape (n, 4, 4) or (n, 7)"), "{text}");
    let whole = npy("whole.npy", "<i8", "(1, 7)", &doubles([0.0; 7]));
    assert!(message(&whole, &[]).contains("found an array of the type `<i8`, expected"));
    let short = npy("short.npy", "<f8", "(9, 7)", &doubles(POSES[0]));
    let text = message(&short, &["--quiet"]);
    assert!(text.contains("short.npy:2: found the end of the file, expected pose 2 of 9"), "{text}");
    assert_eq!(text.matches("end of the file").count(), 1);
    let rows = npy("fit.npy", "<f8", "(1, 7)", &doubles(POSES[0]));
    let out = place("unfit.npz").display().to_string();
    assert!(message(&rows, &["-o", &out, "--jsonl"]).contains("found --jsonl with"));
}
