//! The result of a search for conditions of 5R and 6R loops: the verdict first, then what was tried; as text and JSON.

use super::table::{Columns, paragraph};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::text::{Format, Names};
use crate::catalogue::ansatz::{Ansatz, Link};
use crate::conditions::composed::Composed;
use crate::conditions::curve_ansatz::{Curve, Relation};
use crate::conditions::examples::first;
use crate::conditions::formulas::Formulas;
use crate::conditions::pattern::TwistPattern;
use crate::conditions::search::{CurveLoop, CurveSearch, FamilyProof, Fitted, MobileSlice, SLICE_PRIME, Search};
use crate::conditions::step::{factored, plain, product, ratio_text, rational};
use crate::conditions::sweep::{Evidence, Sweep};
use crate::conditions::symmetry::{Signs, Slice};
use crate::conditions::verification::{ModularMembers, RationalMember};
use crate::error::{Error, Result};
use crate::mobility::{Germ, Local};
use crate::verdict::Proof;
use rug::Rational;
use serde_json::{Value, json};
use std::fmt::Write;

/// The certainty that the mechanisms found move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Certainty {
    /// Proved for all parameters.
    Family,
    /// But for a probability below two to the power of minus this.
    Probable(u32),
    /// A member over the rationals is proved; nothing is said of the others.
    Member,
    /// There is no proof.
    Conjecture,
}

impl Certainty {
    fn name(self) -> &'static str {
        match self {
            Self::Family => "proved for all parameters",
            Self::Probable(_) => "probability of error",
            Self::Member => "proved for a member",
            Self::Conjecture => "conjecture",
        }
    }

    fn bound(self) -> Option<String> {
        if let Self::Probable(power) = self { Some(format!("2^-{power}")) } else { None }
    }
}

/// Closed positions all of which satisfy the condition.
const IMPLIED: u32 = 50;
/// Random members that all move.
const MEMBERS: u32 = 39;

fn member_moves(member: Option<&RationalMember>) -> bool {
    member.is_some_and(|member| member.germ.local == Local::Curve)
}

fn fitted_certainty(search: &Search, fitted: &Fitted) -> Certainty {
    let implied = fitted.closed.filter(|closed| closed.positions > 0 && closed.satisfied == closed.positions);
    let of_curves = search.curves.as_ref().is_some_and(|curves| curves.loops.iter().any(CurveLoop::is_proved));
    let modular = fitted.modular.is_some_and(|modular| modular.all_move());
    // Without a relation every member belongs to the family.
    let symmetric = fitted.sweep.always && own_pattern(search).is_some();
    let by_formulas = search.curves.as_ref().is_some_and(|curves| curves.loops.iter().any(CurveLoop::is_proved_family));
    if fitted.proof.is_some() || symmetric || by_formulas {
        Certainty::Family
    } else if implied.is_some() {
        Certainty::Probable(IMPLIED)
    } else if modular {
        Certainty::Probable(MEMBERS)
    } else if member_moves(fitted.member.as_ref()) || of_curves {
        Certainty::Member
    } else {
        Certainty::Conjecture
    }
}

/// A symmetric family that is proved to move and that all members of the ansatz belong to.
fn own_pattern(search: &Search) -> Option<&TwistPattern> {
    search.patterns.iter().find(|pattern| pattern.conditions.is_empty() && pattern.proved)
}

/// Returns the certainty that the members of an ansatz without unknown symbols move.
fn own_certainty(search: &Search) -> Certainty {
    let modular = search.modular.is_some_and(|modular| modular.all_move());
    match () {
        () if own_pattern(search).is_some() || search.proof.is_some() => Certainty::Family,
        () if modular => Certainty::Probable(MEMBERS),
        () if member_moves(search.member.as_ref()) => Certainty::Member,
        () => Certainty::Conjecture,
    }
}

/// Returns whether the result is proved, for the requested family or for a member of it.
#[must_use]
pub fn is_proved(search: &Search) -> bool {
    if let Some(fitted) = &search.fitted {
        let found = fitted.sweep.always || !fitted.sweep.relations.is_empty();
        return found
            && match fitted_certainty(search, fitted) {
                Certainty::Family => true,
                // For five joints, what moves is known by its members.
                Certainty::Member => search.curves.is_some(),
                _ => false,
            };
    }
    if !search.composed.is_empty() {
        return proper_slices(search).all(|slice| slice.proof.is_some());
    }
    if let Some(curves) = &search.curves {
        let mut proper = curves.loops.iter().filter(|found| found.is_proper() && found.in_ansatz).peekable();
        return proper.peek().is_some() && proper.all(CurveLoop::is_proved);
    }
    if search.modular.is_some() {
        return own_certainty(search) == Certainty::Family;
    }
    search.mobile_slices.iter().all(|slice| slice.proof.is_some()) && proper_slices(search).count() > 0
}

/// Returns the proof of the answer. The primes behind a bound on the probability of error are not drawn: nothing here is
/// `probable`.
#[must_use]
pub fn proof(ansatz: &Ansatz, search: &Search) -> Proof {
    let proof = if is_proved(search) || empty(ansatz, search).is_some() { Proof::Proved } else { Proof::None };
    proof.of_rounded(ansatz.rounded)
}

/// Returns the reason why no real mechanism satisfies the request or the result; `None` where that is not proved.
#[must_use]
pub fn empty<'a>(ansatz: &'a Ansatz, search: &'a Search) -> Option<&'a str> {
    ansatz.empty().or_else(|| search.fitted.as_ref()?.empty.as_deref())
}

fn proper_slices(search: &Search) -> impl Iterator<Item = &MobileSlice> {
    search.mobile_slices.iter().filter(|mobile| mobile.slice.slice == Slice::Mobile)
}

/// A condition in factors.
fn condition(polynomial: &Polynomial<Rational>, names: &Names) -> String {
    product(&factored(&polynomial.primitive().0, &[]), names)
}

fn conditions(list: &[Polynomial<Rational>], names: &Names) -> String {
    list.iter().map(|one| format!("{} = 0", condition(one, names))).collect::<Vec<_>>().join(", ")
}

/// Returns the result, and how far it is proved.
#[must_use]
pub fn verdict(ansatz: &Ansatz, search: &Search) -> String {
    if let Some(reason) = empty(ansatz, search) {
        return format!("no real mechanism: the real solution set is empty, {reason}");
    }
    if let Some(fitted) = &search.fitted {
        return fit_verdict(ansatz, search, fitted);
    }
    if !search.composed.is_empty() {
        let names: Vec<&str> = search.composed.iter().map(|one| one.name).collect();
        let symmetric = proper_slices(search).count();
        let more = if symmetric > 0 { format!("{symmetric} by symmetry and {} ", names.len()) } else { String::new() };
        let sure = if is_proved(search) { "all proved for all parameters" } else { "some of them on evidence only" };
        return format!(
            "{} families that move, {more}made of Bennett loops ({}): {sure}; others are not excluded",
            symmetric + names.len(),
            names.join("; ")
        );
    }
    if let Some(curves) = &search.curves {
        return curve_verdict(curves);
    }
    if search.modular.is_none() {
        return match proper_slices(search).count() {
            0 => "no symmetry found that moves for all lengths".to_owned(),
            n => {
                let proved = proper_slices(search).filter(|slice| slice.proof.is_some()).count();
                format!("{n} symmetric families that move for all lengths, {proved} of them proved for all parameters")
            }
        };
    }
    let member = if member_moves(search.member.as_ref()) { ", a member proved over the rationals" } else { "" };
    match own_certainty(search) {
        Certainty::Family => {
            let name = own_pattern(search).map(|pattern| format!(" by symmetry, {}", pattern.involution));
            format!("mobile{}: proved for all parameters{member}", name.unwrap_or_default())
        }
        Certainty::Probable(power) => format!("mobile: probability of error <= 2^-{power}{member}"),
        Certainty::Member => {
            "a random member over the rationals is proved mobile; nothing is said of the others".to_owned()
        }
        Certainty::Conjecture => {
            let rigid = search
                .modular
                .filter(|modular| modular.members > 0)
                .map(|modular| format!("{} of {} random members move", modular.mobile, modular.members));
            let member =
                search.member.as_ref().map(|member| format!("one over the rationals: {}", local(&member.germ)));
            let said: Vec<String> = rigid.into_iter().chain(member).collect();
            let partial = if search.patterns.iter().any(|pattern| pattern.proved) {
                "; with further conditions on lengths it moves by symmetry"
            } else {
                ""
            };
            match said.as_slice() {
                [] => format!("no mobile member found: no closed position was met{partial}"),
                _ => format!("no mobile member found: {}{partial}", said.join("; ")),
            }
        }
    }
}

fn curve_verdict(curves: &CurveSearch) -> String {
    let at = if curves.chosen { "example twists" } else { "these twists" };
    let proper: Vec<&CurveLoop> = curves.loops.iter().filter(|found| found.is_proper()).collect();
    let own: Vec<&&CurveLoop> = proper.iter().filter(|found| found.in_ansatz).collect();
    let proved = own.iter().filter(|found| found.is_proved()).count();
    let for_all = own.iter().filter(|found| found.formulas.as_ref().is_some_and(|f| f.proved)).count();
    let formulas = if for_all > 0 { format!(", {for_all} for all twists by an identity") } else { String::new() };
    match (own.len(), proper.len()) {
        (0, 0) => format!("no mobile lengths found for {at} among curves with two tied joints"),
        (0, n) => {
            format!("no mobile member found for {at}: of the {n} mobile choices of lengths none is in the ansatz")
        }
        (own, n) if own == n => {
            format!("{n} mobile choices of lengths for {at}, {proved} of them proved over the rationals{formulas}")
        }
        (own, n) => format!(
            "{own} of the {n} mobile choices of lengths for {at} are in the ansatz, {proved} of them proved over the \
             rationals{formulas}"
        ),
    }
}

fn fit_verdict(ansatz: &Ansatz, search: &Search, fitted: &Fitted) -> String {
    let certainty = fitted_certainty(search, fitted);
    let by_curve = search.curves.as_ref().is_some_and(|curves| curves.loops.iter().any(CurveLoop::is_proved));
    let member =
        if member_moves(fitted.member.as_ref()) || by_curve { ", a member proved over the rationals" } else { "" };
    let sure = match certainty {
        Certainty::Probable(power) => format!("probability of error <= 2^-{power}"),
        Certainty::Family => "proved for all parameters".to_owned(),
        Certainty::Member | Certainty::Conjecture => "a conjecture".to_owned(),
    };
    let running = fitted.sweep.running.join(", ");
    if fitted.sweep.always {
        return format!("mobile for all values of {running}, no condition: {sure}{member}");
    }
    let found = said(ansatz, fitted);
    if found.is_empty() {
        let members = fitted.sweep.evidence.iter().map(|evidence| evidence.members).max().unwrap_or(0);
        let why = if members == 0 { "no mobile members met" } else { "no relation among the terms" };
        return format!("no condition found in this ansatz: {why}");
    }
    format!("mobile where {}: {sure}{member}{}", found.join(", "), hypotheses(certainty, fitted.proof.as_ref()))
}

/// Returns the hypotheses of the theorem for all parameters about a position.
fn hypotheses(certainty: Certainty, proof: Option<&FamilyProof>) -> &'static str {
    match proof.filter(|_| matches!(certainty, Certainty::Family)) {
        Some(FamilyProof::Multiplier(_)) => {
            "; through every real closed position of screw rank 5 with w not 0 and axes that span the space"
        }
        Some(FamilyProof::Implication(_)) => {
            "; through every real closed position of screw rank 5 at which the two axes are not perpendicular"
        }
        None => "",
    }
}

/// The relations that were fitted, those between angles as one equation.
fn said(ansatz: &Ansatz, fitted: &Fitted) -> Vec<String> {
    let names = ansatz.symbols.names();
    let first = 3 * ansatz.symbols.angles.len();
    let angle = fitted.family.as_ref().and_then(|family| family.angle.clone());
    let has_length = |relation: &&Polynomial<Rational>| (first..relation.variables()).any(|k| relation.degree(k) > 0);
    let shown = fitted.sweep.relations.iter().filter(|relation| angle.is_none() || has_length(relation));
    let texts = shown.map(|relation| format!("{} = 0", condition(relation, names)));
    angle.iter().cloned().chain(texts).collect()
}

/// Describes the set of positions near one position.
fn local(germ: &Germ<Rational>) -> String {
    match &germ.local {
        Local::Curve => "a smooth curve of positions, zero through order 16".to_owned(),
        Local::Isolated { order } => format!("isolated, of order {order}"),
        Local::Manifold { dimension } => {
            format!("positions of dimension {dimension}, of joints that form a group of motions")
        }
        Local::Open => "not closed".to_owned(),
        Local::Deficient => format!("not decided: rank {}", germ.rank),
    }
}

fn signs(signs: Signs) -> String {
    let sign = |name: &str, negative: bool| format!("{name} {}", if negative { "negated" } else { "equal" });
    [("angles", signs.angle), ("twists", signs.twist), ("lengths", signs.length), ("offsets", signs.offset)]
        .map(|(name, negative)| sign(name, negative))
        .join(", ")
}

/// The length pattern of a slice, as `a4 = a1, d4 = -d1`.
fn pattern(mobile: &MobileSlice) -> String {
    let slice = &mobile.slice;
    let equations = |letter: &str, map: &[usize], negative: bool| -> Vec<String> {
        let equation = |(k, &image): (usize, &usize)| match (k < image, k == image && negative) {
            (true, _) => Some(format!("{letter}{} = {}{letter}{}", image + 1, if negative { "-" } else { "" }, k + 1)),
            (_, true) => Some(format!("{letter}{} = 0", k + 1)),
            _ => None,
        };
        map.iter().enumerate().filter_map(equation).collect()
    };
    let (joints, links) = (&slice.involution.joints, &slice.involution.links);
    let mut all = equations("alpha", links, slice.signs.twist);
    all.extend(equations("a", links, slice.signs.length));
    all.extend(equations("d", joints, slice.signs.offset));
    all.join(", ")
}

fn tie(curve: &Curve<Rational>) -> String {
    let (i, j) = (curve.tie.first + 1, curve.tie.second + 1);
    match curve.tie.relation {
        Relation::Product => format!("tan(theta{i}/2) tan(theta{j}/2) = {}", curve.constant),
        Relation::Quotient => format!("tan(theta{j}/2) = {} tan(theta{i}/2)", curve.constant),
    }
}

fn lengths(vectors: &[Vec<Rational>]) -> Vec<String> {
    let vector = |vector: &Vec<Rational>| {
        let list = |part: &[Rational]| part.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
        let (a, d) = vector.split_at(vector.len() / 2);
        format!("a = ({}), d = ({})", list(a), list(d))
    };
    vectors.iter().map(vector).collect()
}

/// Why a loop is degenerate; empty for a proper one.
fn degenerate(found: &CurveLoop) -> Vec<String> {
    let mut reasons = Vec::new();
    let curve = &found.curves[0];
    let still: Vec<String> =
        (1..).zip(&curve.moving).filter(|(_, moves)| !**moves).map(|(joint, _)| joint.to_string()).collect();
    if !still.is_empty() {
        reasons.push(format!("joint {} locked", still.join(", ")));
    }
    reasons.extend(curve.coincident.iter().map(|(i, j)| format!("axes {} and {} coincide", i + 1, j + 1)));
    reasons
}

fn roots(evidence: &Evidence) -> String {
    let count = |(roots, draws): (&usize, &usize)| format!("{roots} in {draws}");
    evidence.roots.iter().map(count).collect::<Vec<_>>().join(", ")
}

/// Everything for a reader.
#[must_use]
pub fn text(ansatz: &Ansatz, search: &Search) -> String {
    let mut text = verdict(ansatz, search) + "\n";
    if let Some(fitted) = &search.fitted {
        fit_text(ansatz, fitted, &mut text);
    }
    composed_text(search, &mut text);
    if let Some(curves) = search.curves.as_ref().filter(|curves| !curves.loops.is_empty() || search.composed.is_empty())
    {
        curve_text(curves, &mut text);
    }
    if let Some(member) = &search.member {
        text.push_str("\nRandom member that satisfies the relations\n");
        member_text(member, &mut text);
    }
    modular_text(search.modular, &mut text);
    if let Some(proof) = &search.proof {
        proof_text(proof, &mut text);
    }
    pattern_text(ansatz, search, &mut text);
    slice_text(search, &mut text);
    text.push_str(SCOPE);
    if ansatz.rounded {
        text.push_str(ROUNDED);
    }
    text
}

const ROUNDED: &str = "\nwarning: numbers of the file without rational value or half-angle tangent are replaced by rationals nearby \
                       (--digits): everything here is exact for those, and a relation between such numbers may be lost\n";

fn modular_text(modular: Option<ModularMembers>, text: &mut String) {
    if let Some(ModularMembers { members, mobile }) = modular.filter(|modular| modular.members > 0) {
        let _ = writeln!(
            text,
            "  random members with a closed position modulo 2^61 - 1 and 2^62 - 57: {mobile} of {members} pass the order test; if \
             general members did not move, each of them would with a probability below 2^-{MEMBERS} only"
        );
    }
}

fn composed_text(search: &Search, text: &mut String) {
    for one in &search.composed {
        let _ = writeln!(text, "\n{}", one.name);
        paragraph(text, one.made);
        let _ = writeln!(text, "  conditions on tangents t of half twists, lengths a and offsets d (each = 0)");
        for condition in one.texts() {
            let _ = writeln!(text, "    {condition}");
        }
        text.push_str("  motion, x any number\n");
        for (number, ratio) in (1..).zip(one.motion()) {
            let _ = writeln!(text, "    tan(theta{number}/2) = {ratio}");
        }
        if let Some(example) = first(&search.examples, &|own| one.contains(&own.links)) {
            let _ = writeln!(text, "  in the library: {example}");
        }
        text.push_str("  proof: the product of all joints and links, expanded in x and the parameters, is a number\n  an example that moves, by the order test at x = 2/3\n");
        for (number, link) in (1..).zip(&one.example) {
            let _ = writeln!(text, "    link {number}: {}", link_text(link));
        }
    }
}

/// Returns the numbers of a link: cosine and sine of its twist, length and offset.
fn link_text(Link { cos, sin, a, d }: &Link<Rational>) -> String {
    format!("cos alpha = {cos}, sin alpha = {sin}, a = {a}, d = {d}")
}

fn pattern_text(ansatz: &Ansatz, search: &Search, text: &mut String) {
    if search.patterns.is_empty() {
        return;
    }
    text.push_str(
        "\nThe twists of this ansatz have the following symmetries, in which it moves for all lengths that satisfy\n",
    );
    for pattern in &search.patterns {
        let list = if pattern.conditions.is_empty() {
            "nothing more: all members belong to the family".to_owned()
        } else {
            conditions(&pattern.conditions, ansatz.symbols.names())
        };
        let sure = if pattern.proved { "proved for all parameters" } else { "evidence at random twists only" };
        let _ = writeln!(text, "  {} from joint {}: {list} ({sure})", pattern.involution, pattern.joint + 1);
    }
}

fn slice_text(search: &Search, text: &mut String) {
    let _ = writeln!(
        text,
        "\nSymmetric families: {} patterns of signs and involutions at random twists modulo {SLICE_PRIME}",
        search.slices
    );
    if search.mobile_slices.is_empty() {
        text.push_str("  none moves for all lengths of its pattern\n");
        return;
    }
    let mut table = Columns::new(
        &["symmetry", "signs", "dimension", "conditions", "lengths", "moves for all lengths", "proved"],
        &["symmetry", "signs", "moves for all lengths", "proved"],
    );
    for mobile in &search.mobile_slices {
        let slice = &mobile.slice;
        let moves = if slice.slice == Slice::Folded { "degenerate, folded back on itself" } else { "yes" };
        table.row([
            slice.involution.name.to_owned(),
            signs(slice.signs),
            slice.dimension.to_string(),
            slice.conditions.to_string(),
            slice.lengths.to_string(),
            moves.to_owned(),
            if mobile.proof.is_some() { "for all parameters" } else { "no: random twists only" }.to_owned(),
        ]);
    }
    text.push_str(&table.text());
    text.push_str("\nTheir patterns, and why they move\n");
    let mut proofs: Vec<&str> = Vec::new();
    for mobile in &search.mobile_slices {
        let slice = &mobile.slice;
        let _ = write!(text, "  {}, {}: {}", slice.involution.name, signs(slice.signs), pattern(mobile));
        if slice.slice == Slice::Folded {
            text.push_str(" (degenerate, folded back on itself)");
        }
        text.push('\n');
        if let Some(example) = first(&search.examples, &|own| mobile.contains(&own.links)) {
            let _ = writeln!(text, "    in the library: {example}");
        }
        match mobile.proof.as_deref() {
            Some(proof) if !proofs.contains(&proof) => {
                proofs.push(proof);
                let _ = writeln!(text, "    proved for all parameters: {proof}");
            }
            Some(_) => text.push_str("    proved for all parameters in the same way\n"),
            None => text.push_str("    no identity known: evidence at random twists only\n"),
        }
    }
}

const SCOPE: &str = "\nWhat was not found may move all the same: loops without such a symmetry, without two tied joints, or with conditions \
                     of other terms.\n";

fn fit_text(ansatz: &Ansatz, fitted: &Fitted, text: &mut String) {
    let Sweep { evidence, relations, terms, trial, running, always } = &fitted.sweep;
    let drawn: Vec<&str> =
        ansatz.unknown_names().into_iter().filter(|name| !running.iter().any(|own| own == name)).collect();
    let drawn =
        if drawn.is_empty() { String::new() } else { format!(" ({} drawn with the parameters)", drawn.join(", ")) };
    let _ = writeln!(text, "\nSweep over {}{drawn} and fit of {terms} terms", running.join(", "));
    if *always {
        text.push_str("  almost all members have a family of configurations, whatever the unknown is\n");
    } else if evidence.is_empty() {
        text.push_str("  no members with a family of configurations were met\n");
    }
    for evidence in evidence {
        let _ = writeln!(
            text,
            "  modulo {}: {} draws of the parameters; values of the unknown with a family of configurations: {}; {} relations \
             fit {} members",
            evidence.prime,
            evidence.draws,
            roots(evidence),
            evidence.relations,
            evidence.members
        );
    }
    for relation in relations {
        let _ = writeln!(text, "  {} = 0", condition(relation, ansatz.symbols.names()));
    }
    if let Some(trial) = trial {
        let _ = writeln!(
            text,
            "  fresh members modulo {}: {} of {} on it move, {} of {} off it",
            trial.prime, trial.mobile_on, trial.on, trial.mobile_off, trial.off
        );
    }
    if let Some(closed) = fitted.closed.filter(|closed| closed.positions > 0) {
        let _ = write!(
            text,
            "  closed positions of random members modulo 2^61 - 1: {} of {} satisfy it",
            closed.satisfied, closed.positions
        );
        text.push_str(if closed.satisfied == closed.positions {
            ", so closure implies mobility but for a probability <= 2^-50\n"
        } else {
            ": closure does not imply it\n"
        });
    }
    modular_text(fitted.modular, text);
    if let Some(proof) = &fitted.proof {
        proof_text(proof, text);
    }
    if let Some(member) = &fitted.member {
        text.push_str("  random member over the rationals\n");
        member_text(member, text);
    }
}

fn proof_text(proof: &FamilyProof, text: &mut String) {
    match proof {
        FamilyProof::Multiplier(multiplier) => {
            let term = |(i, j, factor): &(usize, usize, Rational)| {
                let factor = if *factor == 1 { String::new() } else { format!("({factor}) ") };
                format!("{factor}z{} x z{}", i + 1, j + 1)
            };
            let terms: Vec<String> = multiplier.terms.iter().map(term).collect();
            let vanishes = if multiplier.size == 0 {
                "vanishes for all members".to_owned()
            } else {
                format!(
                    "{} terms in the cosines and triple products of axes, is divisible by the relation and vanishes on it",
                    multiplier.size
                )
            };
            let _ = writeln!(
                text,
                "  proof for all parameters: with w = {} the product of w and the closing translation, {vanishes}: two of \
                 three equations are left for the three degrees of freedom of the spherical loop, and every real closed \
                 position of screw rank 5 with w not 0 and axes that span the space lies on a curve of positions",
                terms.join(" + ")
            );
        }
        FamilyProof::Implication(implication) => {
            let (i, j) = (implication.joint + 1, implication.joint + 4);
            let _ = writeln!(
                text,
                "  proof for all parameters: r^2 (z{i} . z{j}) - 2 (z{i} . r)(z{j} . r), r from axis {i} to axis {j}, is z{i} . z{j} \
                 times a number made of lengths on both sides of the loop, so that closure implies the relation where z{i} . z{j} \
                 is not 0: every such real closed position of screw rank 5 lies on a curve of positions"
            );
        }
    }
}

fn curve_text(curves: &CurveSearch, text: &mut String) {
    let twists: Vec<String> = curves.twists.iter().map(ToString::to_string).collect();
    let chosen = if curves.chosen { ", chosen at random" } else { "" };
    let _ = writeln!(text, "\nCurves with two tied joints, tan(alpha/2) = ({}){chosen}", twists.join(", "));
    if curves.loops.is_empty() {
        text.push_str(
            "  none on which lengths close, for all pairs of joints, both relations and rational constants\n",
        );
    }
    for found in &curves.loops {
        let reasons = degenerate(found);
        let mut note = if reasons.is_empty() { String::new() } else { format!("degenerate, {}: ", reasons.join(", ")) };
        if !found.in_ansatz {
            note.insert_str(0, "not in the ansatz, ");
        }
        let _ = writeln!(text, "  {note}{}", local(&found.germ));
        for vector in lengths(&found.lengths) {
            let _ = writeln!(text, "    {vector}");
        }
        for curve in &found.curves {
            let _ = writeln!(text, "    {}", tie(curve));
        }
        if let Some(formulas) = &found.formulas {
            formula_text(formulas, text);
        }
    }
}

fn formula_text(formulas: &Formulas, text: &mut String) {
    let sure = if formulas.proved {
        "proved: the product of all joints and links, expanded in the tangents, is a number".to_owned()
    } else {
        format!("a conjecture, fitted to {} random twists", formulas.samples)
    };
    let _ = writeln!(text, "    for all twists of the ansatz ({sure})");
    let _ = writeln!(text, "      {}", conditions(&formulas.conditions, &formulas.names));
    for (number, ratio) in (1..).zip(&formulas.motion) {
        let _ = writeln!(text, "      tan(theta{number}/2) = {}", ratio_text(ratio, &formulas.motion_names));
    }
}

fn member_text(member: &RationalMember, text: &mut String) {
    for (number, link) in (1..).zip(&member.links) {
        let _ = writeln!(text, "    link {number}: {}", link_text(link));
    }
    let _ = writeln!(text, "    screw rank {}: {}", member.germ.rank, local(&member.germ));
}

/// The document that equations/conditions_search.schema.json describes.
#[must_use]
pub fn json(ansatz: &Ansatz, search: &Search) -> Value {
    let slice = |mobile: &MobileSlice| {
        json!({
            "involution": mobile.slice.involution.name,
            "conditions": pattern(mobile),
            "degenerate": mobile.slice.slice == Slice::Folded,
            "library": first(&search.examples, &|own| mobile.contains(&own.links)),
            "proof": mobile.proof,
        })
    };
    let own_symmetry = |pattern: &TwistPattern| {
        let list = pattern.conditions.iter().map(|one| condition(one, ansatz.symbols.names()));
        json!({
            "involution": pattern.involution,
            "joint": pattern.joint + 1,
            "conditions": list.collect::<Vec<_>>(),
            "proved": pattern.proved,
        })
    };
    json!({
        "title": ansatz.title,
        "joints": ansatz.joints.len(),
        "verdict": verdict(ansatz, search),
        "proved": proof(ansatz, search).is_proved(),
        "proof": proof(ansatz, search).word(),
        "complete": false,
        "certainty": certainty(search).map(|certainty| json!({
            "name": certainty.name(),
            "probability_of_error": certainty.bound(),
        })),
        "empty": empty(ansatz, search),
        "unknown": ansatz.unknown_names(),
        "relations": search.fitted.as_ref().map(|fitted| relations(ansatz, fitted)),
        "factors": search.fitted.as_ref().map(|fitted| factors(ansatz, fitted)),
        "evidence": search.fitted.as_ref().map(evidence),
        "members": search.modular.or(search.fitted.as_ref().and_then(|fitted| fitted.modular)).map(|modular| json!({
            "primes": ["2^61 - 1", "2^62 - 57"], "found": modular.members, "mobile": modular.mobile,
        })),
        "own_symmetries": search.patterns.iter().map(own_symmetry).collect::<Vec<_>>(),
        "loops": search.curves.as_ref().map(loops),
        "composed": search.composed.iter().map(|one| composed(search, one)).collect::<Vec<_>>(),
        "symmetries": search.mobile_slices.iter().map(slice).collect::<Vec<_>>(),
        "rounded": ansatz.rounded,
    })
}

fn composed(search: &Search, one: &Composed) -> Value {
    let link = |Link { cos, sin, a, d }: &Link<Rational>| json!({ "cos_alpha": cos.to_string(), "sin_alpha": sin.to_string(), "a": a.to_string(), "d": d.to_string() });
    json!({
        "name": one.name,
        "made": one.made,
        "conditions": one.texts(),
        "tan_half_theta": one.motion(),
        "library": first(&search.examples, &|own| one.contains(&own.links)),
        "example": one.example.iter().map(link).collect::<Vec<_>>(),
        "proved": true,
    })
}

/// Returns the certainty of the result; `None` where nothing was found.
fn certainty(search: &Search) -> Option<Certainty> {
    if !search.composed.is_empty() {
        return is_proved(search).then_some(Certainty::Family);
    }
    match (&search.fitted, &search.curves) {
        (Some(fitted), _) if fitted.sweep.relations.is_empty() && !fitted.sweep.always => None,
        (Some(fitted), _) => Some(fitted_certainty(search, fitted)),
        (None, Some(curves)) => {
            let found = |certain: &dyn Fn(&CurveLoop) -> bool| {
                let mut own = curves.loops.iter().filter(|found| found.is_proper() && found.in_ansatz).peekable();
                own.peek().is_some() && own.all(certain)
            };
            let for_all = |found: &CurveLoop| found.formulas.as_ref().is_some_and(|formulas| formulas.proved);
            match () {
                () if found(&for_all) => Some(Certainty::Family),
                () if found(&CurveLoop::is_proved) => Some(Certainty::Member),
                () => None,
            }
        }
        (None, None) if search.modular.is_some() => {
            Some(own_certainty(search)).filter(|certainty| *certainty != Certainty::Conjecture)
        }
        (None, None) => is_proved(search).then_some(Certainty::Family),
    }
}

fn relations(ansatz: &Ansatz, fitted: &Fitted) -> Vec<String> {
    let text = |relation| Format::Text.polynomial(relation, ansatz.symbols.names());
    fitted.sweep.relations.iter().map(text).collect()
}

/// The factors of each relation, with their powers.
fn factors(ansatz: &Ansatz, fitted: &Fitted) -> Vec<Value> {
    let names = ansatz.symbols.names();
    let factor = |(factor, power): &(_, u32)| json!({ "text": plain(factor, names), "multiplicity": power });
    let of = |relation: &Polynomial<Rational>| -> Value {
        factored(&relation.primitive().0, &[]).iter().map(factor).collect()
    };
    fitted.sweep.relations.iter().map(of).collect()
}

fn evidence(fitted: &Fitted) -> Value {
    let sweep = |evidence: &Evidence| {
        json!({
            "prime": evidence.prime, "draws": evidence.draws, "members": evidence.members, "relations": evidence.relations,
        })
    };
    json!({
        "terms": fitted.sweep.terms,
        "running": fitted.sweep.running,
        "always": fitted.sweep.always,
        "sweeps": fitted.sweep.evidence.iter().map(sweep).collect::<Vec<_>>(),
        "trial": fitted.sweep.trial.map(|trial| json!({
            "prime": trial.prime, "on": trial.on, "mobile_on": trial.mobile_on, "off": trial.off, "mobile_off": trial.mobile_off,
        })),
        "closed_positions": fitted.closed.map(|closed| json!({ "found": closed.positions, "satisfied": closed.satisfied })),
        "member": fitted.member.as_ref().map(|member| local(&member.germ)),
        "family_proof": fitted.proof.is_some(),
    })
}

fn loops(curves: &CurveSearch) -> Value {
    let found = |found: &CurveLoop| {
        let formulas = found.formulas.as_ref().map(|formulas| {
            let conditions = formulas.conditions.iter().map(|one| condition(one, &formulas.names));
            let motion = formulas.motion.iter().map(|ratio| ratio_text(ratio, &formulas.motion_names));
            json!({
                "conditions": conditions.collect::<Vec<_>>(),
                "tan_half_theta": motion.collect::<Vec<_>>(),
                "proved": formulas.proved,
                "samples": formulas.samples,
            })
        });
        json!({
            "lengths": lengths(&found.lengths),
            "ties": found.curves.iter().map(tie).collect::<Vec<_>>(),
            "degenerate": degenerate(found),
            "local": local(&found.germ),
            "in_ansatz": found.in_ansatz,
            "formulas": formulas,
        })
    };
    json!({
        "tan_half_alpha": curves.twists.iter().map(ToString::to_string).collect::<Vec<_>>(),
        "found": curves.loops.iter().map(found).collect::<Vec<_>>(),
    })
}

/// Returns the result as Markdown, with conditions in LaTeX.
///
/// # Errors
/// None for the result of a search.
pub fn markdown(ansatz: &Ansatz, search: &Search) -> Result<String> {
    let mut text = format!("# {}\n\n{}.\n", ansatz.title, verdict(ansatz, search));
    for (name, conditions, names) in families(ansatz, search) {
        let lines = Format::Latex.system(&conditions, &names)?.replace("align*", "aligned");
        let _ = write!(text, "\n## Conditions: {name}\n\nAll of these vanish:\n\n$$\n{lines}$$\n");
    }
    let _ =
        write!(text, "\n## What was searched, and how far it is proved\n\n```\n{}```\n", self::text(ansatz, search));
    Ok(text)
}

/// The conditions that were found, family by family: what was fitted, the formulas of loops of five joints, the symmetric
/// families of the twists.
fn families(ansatz: &Ansatz, search: &Search) -> Vec<(String, Vec<Polynomial<Rational>>, Names)> {
    let names = ansatz.symbols.names();
    let mut families = Vec::new();
    if let Some(fitted) = search.fitted.as_ref().filter(|fitted| !fitted.sweep.relations.is_empty()) {
        families.push(("fitted".to_owned(), fitted.sweep.relations.clone(), names.clone()));
    }
    let loops = search.curves.iter().flat_map(|curves| &curves.loops).filter_map(|found| found.formulas.as_ref());
    for (number, formulas) in (1..).zip(loops) {
        families.push((format!("loop {number}"), formulas.conditions.clone(), formulas.names.clone()));
    }
    for one in &search.composed {
        families.push((one.name.to_owned(), one.conditions.iter().map(rational).collect(), one.names()));
    }
    for pattern in search.patterns.iter().filter(|pattern| !pattern.conditions.is_empty()) {
        let name = format!("{} from joint {}", pattern.involution, pattern.joint + 1);
        families.push((name, pattern.conditions.clone(), names.clone()));
    }
    families
}

/// The conditions of one family in the language of another program; without a name, of the first one.
///
/// # Errors
/// Where none was found, or none of this name, or the language has no way to say it.
pub fn system(ansatz: &Ansatz, search: &Search, family: Option<&str>, format: Format) -> Result<String> {
    let families = families(ansatz, search);
    if families.is_empty() {
        return Err(Error::Unsupported("no condition was found that could be written".to_owned()));
    }
    let wanted = family.unwrap_or_default().to_lowercase();
    if let Some((_, conditions, names)) = families.iter().find(|(name, ..)| name.to_lowercase().contains(&wanted)) {
        return Ok(format.system(conditions, names)?);
    }
    let known: Vec<&str> = families.iter().map(|(name, ..)| name.as_str()).collect();
    Err(Error::Invalid(format!("found no family `{wanted}`, expected a part of one of: {}", known.join("; "))))
}
