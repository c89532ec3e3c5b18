//! The score of a solver on a file of problems: tables, JSON, a LaTeX table.

use super::table::Columns;
use crate::benchmark::accuracy::quantiles;
use crate::benchmark::published::{Errors, MULTIPLE, Score, Tally};
use serde_json::{Map, Value, json};

const HEADER: [&str; 15] = [
    "",
    "problems",
    "answered",
    "complete",
    "true",
    "found",
    "lost",
    "spurious",
    "double",
    "certified",
    "position",
    "99 %",
    "rotation",
    "99 %",
    "median ms",
];

/// The tables by class and by decade of the condition number.
#[must_use]
pub fn text(solver: &str, score: &Score) -> String {
    let Tally { problems, found, lost, spurious, duplicates, .. } = score.all;
    let mut text = format!(
        "{solver}: {problems} problems: {found} true solutions found, {lost} lost, {spurious} spurious, {duplicates} \
         duplicates\n\n"
    );
    let mut table = Columns::new(&header("class"), &["class"]);
    for (class, tally) in &score.classes {
        table.row(row(class, tally));
    }
    table.row(row("all", &score.all));
    text += &table.text();
    let mut table = Columns::new(&header("condition")[..], &["condition"]);
    for (decade, tally) in &score.decades {
        // Problems, spurious answers and times belong to no single true solution.
        let mut cells = row(&decade_name(*decade), tally);
        for column in [1, 2, 3, 7, 14] {
            cells[column] = "-".to_owned();
        }
        table.row(cells);
    }
    text.push('\n');
    text += &table.text();
    text += "errors are medians and 99 % of all true solutions found, of position as parts of the size of the mechanism, of \
             rotation in radians\n";
    for (class, numbers) in &score.numbers {
        let counts: Vec<String> =
            numbers.iter().map(|(solutions, problems)| format!("{solutions}: {problems}")).collect();
        text += &format!("{class}: problems by their number of true solutions: {}\n", counts.join(", "));
    }
    let Tally { self_motions, detected, invented, setup_seconds, .. } = &score.all;
    if self_motions + invented > 0 {
        text += &format!(
            "self-motions: {detected} of {self_motions} are told, and {invented} where the solutions are isolated\n"
        );
    }
    if !setup_seconds.is_empty() {
        let [median, p99, ..] = quantiles(setup_seconds).map(|seconds| 1e3 * seconds);
        text += &format!("set-up of a mechanism: {median:.3} ms in the median, 99 % below {p99:.3} ms\n");
    }
    text
}

fn header(first: &'static str) -> [&'static str; 15] {
    let mut header = HEADER;
    header[0] = first;
    header
}

/// A decade of condition numbers in words.
#[must_use]
pub fn decade_name(decade: i32) -> String {
    if decade == MULTIPLE { "multiple".to_owned() } else { format!("1e{decade} to 1e{}", decade + 1) }
}

fn errors(tally: &Tally, of: fn(&Errors) -> f64) -> Vec<f64> {
    tally.errors.iter().map(of).collect()
}

fn row(name: &str, tally: &Tally) -> [String; 15] {
    let spread = |of: fn(&Errors) -> f64| {
        let [median, p99, ..] = quantiles(&errors(tally, of));
        [median, p99].map(|x| if x.is_nan() { "-".to_owned() } else { format!("{x:.1e}") })
    };
    let ([position, far], [rotation, wide]) = (spread(|e| e.position), spread(|e| e.rotation));
    let [time, ..] = quantiles(&tally.seconds);
    let counts = [
        tally.problems,
        tally.answered,
        tally.complete,
        tally.truths,
        tally.found,
        tally.lost,
        tally.spurious,
        tally.duplicates,
        tally.certified,
    ];
    let [problems, answered, complete, truths, found, lost, spurious, double, certified] =
        counts.map(|n| n.to_string());
    let time = if time.is_nan() { "-".to_owned() } else { format!("{:.3}", 1e3 * time) };
    [
        name.to_owned(),
        problems,
        answered,
        complete,
        truths,
        found,
        lost,
        spurious,
        double,
        certified,
        position,
        far,
        rotation,
        wide,
        time,
    ]
}

/// Returns the score as JSON.
#[must_use]
pub fn document(solver: &str, hash: &str, score: &Score) -> Value {
    let classes: Map<String, Value> = score.classes.iter().map(|(name, own)| (name.clone(), tally(own))).collect();
    let decades: Map<String, Value> =
        score.decades.iter().map(|(decade, own)| (decade_name(*decade), tally(own))).collect();
    let mechanisms: Map<String, Value> =
        score.mechanisms.iter().map(|(name, own)| (name.clone(), tally(own))).collect();
    json!({
        "solver": solver, "hash": hash, "all": tally(&score.all), "classes": classes, "condition": decades,
        "mechanisms": mechanisms, "numbers": score.numbers,
        "lost_in": score.lost_in,
    })
}

fn tally(own: &Tally) -> Value {
    let spread = |values: &[f64]| {
        let [median, p99, p999, largest] = quantiles(values);
        json!({ "median": median, "p99": p99, "p999": p999, "max": largest })
    };
    json!({
        "problems": own.problems, "answered": own.answered, "complete": own.complete, "true": own.truths, "found": own.found, "lost": own.lost,
        "spurious": own.spurious, "duplicates": own.duplicates, "certified": own.certified,
        "position": spread(&errors(own, |e| e.position)), "rotation": spread(&errors(own, |e| e.rotation)),
        "unknowns": spread(&errors(own, |e| e.unknowns)), "seconds": spread(&own.seconds), "setup_seconds": spread(&own.setup_seconds),
        "self_motions": { "problems": own.self_motions, "told": own.detected, "told_of_isolated": own.invented },
    })
}

/// A table for a paper, in the package `booktabs`: a line for each class.
#[must_use]
pub fn latex(solver: &str, hash: &str, score: &Score) -> String {
    let mut text = format!(
        "% {solver} on the problems {hash}: made by `looproot bench score --paper`\n\\begin{{tabular}}{{lrrrrrrrrr}}\n\\toprule\n\
         class & problems & complete & solutions & found & lost & spurious & position & rotation & ms \\\\\n\\midrule\n",
        solver = escaped(solver)
    );
    for (name, own) in score.classes.iter().map(|(name, own)| (name.as_str(), own)).chain([("all", &score.all)]) {
        if name == "all" {
            text += "\\midrule\n";
        }
        let [_, problems, _, complete, truths, found, lost, spurious, _, _, position, _, rotation, _, time] =
            row(name, own);
        let [position, rotation] = [position, rotation].map(|x| scientific(&x));
        let name = escaped(name);
        text += &format!(
            "{name} & {problems} & {complete} & {truths} & {found} & {lost} & {spurious} & {position} & {rotation} & {time} \\\\\n"
        );
    }
    text + "\\bottomrule\n\\end{tabular}\n"
}

/// Returns two tables with commas, with the names of their files: the histogram of the errors, in half decades from 1e-17 to 1e-3, and the counts
/// of every mechanism.
#[must_use]
pub fn tables(score: &Score) -> [(&'static str, String); 2] {
    let of = [|e: &Errors| e.position, |e: &Errors| e.rotation, |e: &Errors| e.unknowns];
    let values = of.map(|of| errors(&score.all, of));
    let mut histogram = "from,to,position,rotation,unknowns\n".to_owned();
    for half in -34..-6 {
        let [low, high] = [half, half + 1].map(|half| 10.0_f64.powf(f64::from(half) / 2.0));
        // The first and the last bin hold what is beyond.
        let is_in = |x: &&f64| (half == -34 || **x >= low) && (half == -7 || **x < high);
        let [position, rotation, unknowns] = values.each_ref().map(|values| values.iter().filter(is_in).count());
        histogram += &format!("{low:.2e},{high:.2e},{position},{rotation},{unknowns}\n");
    }
    let mut mechanisms = "mechanism,problems,answered,complete,true,found,lost,spurious,double,certified\n".to_owned();
    for (name, own) in &score.mechanisms {
        let name = name.replace(|c: char| c.is_control() || c == ',', " ");
        let counts = &row(&name, own)[..10];
        mechanisms += &format!("{}\n", counts.join(","));
    }
    [("errors.csv", histogram), ("mechanisms.csv", mechanisms)]
}

/// Returns an entry for BibTeX, which names the problems and the program that scored them.
#[must_use]
pub fn bibliography(hash: &str) -> String {
    let version = env!("CARGO_PKG_VERSION");
    format!(
        "@misc{{looproot,\n  title = {{looproot {version}: all solutions of kinematic closure equations, and benchmark problems with their solutions}},\n  \
         note = {{problems with the hash {}, scored by `looproot bench score`}},\n}}\n",
        escaped(hash)
    )
}

/// `1.2e-15` as a formula.
fn scientific(number: &str) -> String {
    number.split_once('e').map_or_else(|| number.to_owned(), |(m, power)| format!("${m}\\cdot10^{{{power}}}$"))
}

fn escaped(words: &str) -> String {
    let one = |c: char| match c {
        '#' | '$' | '%' | '&' | '_' | '{' | '}' => format!("\\{c}"),
        // A line break would end a comment.
        c if c.is_control() => " ".to_owned(),
        c => c.to_string(),
    };
    words.chars().map(one).collect()
}

/// The figures of a score: name of the file, without its ending, and SVG.
#[must_use]
pub fn figures(solver: &str, score: &Score) -> Vec<(&'static str, String)> {
    let of = |of: fn(&Errors) -> f64| errors(&score.all, of);
    let figure =
        |name, what: &str, values: &[f64]| (name, super::histogram::svg(&format!("{solver}: {what}"), what, values));
    vec![
        figure("position", "error of position / size", &of(|e| e.position)),
        figure("rotation", "error of rotation [rad]", &of(|e| e.rotation)),
        figure("unknowns", "error of the unknowns [rad, m]", &of(|e| e.unknowns)),
        figure("seconds", "time of an answer [s]", &score.all.seconds),
    ]
}
