//! What a search for conditions of 5R and 6R loops found: the verdict first, then what was tried; as text and JSON.

use crate::algebra::polynomial::Polynomial;
use crate::algebra::text::Format;
use crate::catalogue::ansatz::{Ansatz, Link};
use crate::conditions::curve_ansatz::{Curve, Relation};
use crate::conditions::search::{CurveLoop, CurveSearch, Fitted, MobileSlice, SLICE_PRIME, Search};
use crate::conditions::sweep::{Evidence, Sweep};
use crate::conditions::symmetry::{Signs, Slice};
use crate::conditions::verification::RationalMember;
use crate::mobility::{Germ, Local};
use rug::Rational;
use serde_json::{Value, json};
use std::fmt::Write;

/// Whether what was found is proved, for the family that was asked for.
#[must_use]
pub fn is_proved(search: &Search) -> bool {
    let member = |member: &Option<RationalMember>| member.as_ref().is_some_and(|m| m.germ.local == Local::Curve);
    match (&search.fitted, &search.curves) {
        (Some(fitted), _) => fitted.is_proved(),
        (None, Some(curves)) => {
            let mut proper = curves.loops.iter().filter(|found| is_proper(found)).peekable();
            proper.peek().is_some() && proper.all(|found| found.germ.local == Local::Curve)
        }
        (None, None) if search.member.is_some() => member(&search.member),
        (None, None) => {
            search.mobile_slices.iter().all(|slice| slice.proof.is_some()) && proper_slices(search).count() > 0
        }
    }
}

fn is_proper(found: &CurveLoop) -> bool {
    found.curves.iter().all(Curve::is_proper)
}

fn proper_slices(search: &Search) -> impl Iterator<Item = &MobileSlice> {
    search.mobile_slices.iter().filter(|mobile| mobile.slice.slice == Slice::Mobile)
}

fn polynomial(ansatz: &Ansatz, polynomial: &Polynomial<Rational>) -> String {
    Format::Text.polynomial(polynomial, ansatz.symbols.names())
}

/// What was found, with how far it is proved.
#[must_use]
pub fn verdict(ansatz: &Ansatz, search: &Search) -> String {
    if let Some(reason) = ansatz.empty() {
        return format!("no real mechanism: the real solution set is empty, {reason}");
    }
    match (&search.fitted, &search.curves, &search.member) {
        (Some(fitted), ..) => fit_verdict(ansatz, fitted),
        (None, Some(curves), _) => {
            let proper: Vec<&CurveLoop> = curves.loops.iter().filter(|found| is_proper(found)).collect();
            let proved = proper.iter().filter(|found| found.germ.local == Local::Curve).count();
            let at = if curves.chosen { "example twists" } else { "these twists" };
            match proper.len() {
                0 => format!("no mobile lengths found for {at} among curves with two tied joints"),
                n => format!("{n} mobile choices of lengths for {at}, {proved} of them proved over the rationals"),
            }
        }
        (None, None, Some(member)) => match member.germ.local {
            Local::Curve => "mobile, proved for a random member over the rationals".to_owned(),
            _ => format!("no mobile member found: random members are {}", local(&member.germ)),
        },
        (None, None, None) => match proper_slices(search).count() {
            0 => "no symmetry found that moves for all lengths".to_owned(),
            n => {
                let proved = proper_slices(search).filter(|slice| slice.proof.is_some()).count();
                format!("{n} symmetric families that move for all lengths, {proved} of them proved for all parameters")
            }
        },
    }
}

fn fit_verdict(ansatz: &Ansatz, fitted: &Fitted) -> String {
    let relations: Vec<String> =
        fitted.sweep.relations.iter().map(|relation| format!("{} = 0", polynomial(ansatz, relation))).collect();
    if relations.is_empty() {
        let members = fitted.sweep.evidence.iter().map(|evidence| evidence.members).max().unwrap_or(0);
        let why = if members == 0 { "no mobile members met" } else { "no relation among the terms" };
        return format!("no condition found in this ansatz: {why}");
    }
    let found = relations.join(", ");
    let implied = fitted.closed.filter(|closed| closed.positions > 0 && closed.satisfied == closed.positions);
    let proved_member = fitted.member.as_ref().is_some_and(|member| member.germ.local == Local::Curve);
    let member = if proved_member { ", a member proved over the rationals" } else { "" };
    if fitted.is_proved() {
        return format!("mobile where {found}: proved for all parameters{member}");
    }
    if implied.is_some() {
        return format!("mobile where {found}: probability of error <= 2^-50{member}");
    }
    format!("mobile where {found}: a conjecture{member}")
}

/// What the positions near one form.
fn local(germ: &Germ<Rational>) -> String {
    match &germ.local {
        Local::Curve => "a smooth curve of positions, zero through order 16".to_owned(),
        Local::Isolated { order } => format!("isolated, of order {order}"),
        Local::Manifold { dimension } => format!("positions of dimension {dimension}"),
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
    if let Some(curves) = &search.curves {
        curve_text(curves, &mut text);
    }
    if let Some(member) = &search.member {
        text.push_str("\nRandom member that satisfies the relations\n");
        member_text(member, &mut text);
        for mobile in search.mobile_slices.iter().filter(|mobile| mobile.contains(&member.links)) {
            let _ = writeln!(
                text,
                "    one of the symmetric family `{}`: {}",
                mobile.slice.involution.name,
                pattern(mobile)
            );
        }
    }
    let _ = writeln!(
        text,
        "\nSymmetric families: {} patterns of signs and involutions at random twists modulo {SLICE_PRIME}",
        search.slices
    );
    if search.mobile_slices.is_empty() {
        text.push_str("  none moves for all lengths of its pattern\n");
    }
    for mobile in &search.mobile_slices {
        let slice = &mobile.slice;
        let what = match slice.slice {
            Slice::Folded => "degenerate, folded back on itself",
            _ => "moves for all lengths",
        };
        let _ = writeln!(text, "  {}, {}: {what}", slice.involution.name, signs(slice.signs));
        let _ = writeln!(text, "    {}", pattern(mobile));
        let _ = writeln!(
            text,
            "    dimension {}, {} conditions on {} lengths, in {} positions",
            slice.dimension, slice.conditions, slice.lengths, slice.positions
        );
        match &mobile.proof {
            Some(proof) => {
                let _ = writeln!(text, "    proved for all parameters: {proof}");
            }
            None => text.push_str("    no identity known: evidence at random twists only\n"),
        }
    }
    text.push_str(SCOPE);
    text
}

const SCOPE: &str = "\nWhat was not found may move all the same: loops without such a symmetry, without two tied joints, or with conditions \
                     of other terms.\n";

fn fit_text(ansatz: &Ansatz, fitted: &Fitted, text: &mut String) {
    let Sweep { evidence, relations, terms, trial } = &fitted.sweep;
    let unknown: Vec<&str> = ansatz.unknown.iter().map(|&k| ansatz.symbols.lengths[k].as_str()).collect();
    let _ = writeln!(text, "\nSweep over {} and fit of {terms} terms", unknown.join(", "));
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
        let _ = writeln!(text, "  {} = 0", polynomial(ansatz, relation));
    }
    if let Some(trial) = trial {
        let _ = writeln!(
            text,
            "  fresh members modulo {}: {} of {} on it move, {} of {} off it",
            trial.prime, trial.mobile_on, trial.on, trial.mobile_off, trial.off
        );
    }
    if let Some(closed) = &fitted.closed {
        let _ = writeln!(
            text,
            "  closed positions of random members modulo 2^61 - 1: {} of {} satisfy it, so closure implies mobility but for a \
             probability <= 2^-50",
            closed.satisfied, closed.positions
        );
    }
    if let Some(multiplier) = &fitted.multiplier {
        let term = |(i, j, factor): &(usize, usize, Rational)| {
            let factor = if *factor == 1 { String::new() } else { format!("({factor}) ") };
            format!("{factor}z{} x z{}", i + 1, j + 1)
        };
        let terms: Vec<String> = multiplier.terms.iter().map(term).collect();
        let _ = writeln!(
            text,
            "  proof for all parameters: with w = {} the product of w and the closing translation, {} terms in the cosines \
             and triple products of axes, is divisible by the relation: on it two of three equations are left for the three \
             degrees of freedom of the spherical loop, and every real closed position of screw rank 5 with w not 0 and axes that \
             span the space lies on a curve of positions",
            terms.join(" + "),
            multiplier.size
        );
    }
    if let Some(implication) = fitted.implication {
        let (i, j) = (implication.joint + 1, implication.joint + 4);
        let _ = writeln!(
            text,
            "  proof for all parameters: r^2 (z{i} . z{j}) - 2 (z{i} . r)(z{j} . r), r from axis {i} to axis {j}, is z{i} . z{j} times a \
             number made of lengths on both sides of the loop, so that closure implies the relation where z{i} . z{j} is not 0: \
             every such real closed position of screw rank 5 lies on a curve of positions"
        );
    }
    if let Some(member) = &fitted.member {
        text.push_str("  random member over the rationals\n");
        member_text(member, text);
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
        let note = if reasons.is_empty() { String::new() } else { format!("degenerate, {}: ", reasons.join(", ")) };
        let _ = writeln!(text, "  {note}{}", local(&found.germ));
        for vector in lengths(&found.lengths) {
            let _ = writeln!(text, "    {vector}");
        }
        for curve in &found.curves {
            let _ = writeln!(text, "    {}", tie(curve));
        }
    }
}

fn member_text(member: &RationalMember, text: &mut String) {
    for (number, link) in (1..).zip(&member.links) {
        let Link { cos, sin, a, d } = link;
        let _ = writeln!(text, "    link {number}: cos alpha = {cos}, sin alpha = {sin}, a = {a}, d = {d}");
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
            "proof": mobile.proof,
        })
    };
    json!({
        "title": ansatz.title,
        "joints": ansatz.joints.len(),
        "verdict": verdict(ansatz, search),
        "proved": is_proved(search),
        "complete": false,
        "empty": ansatz.empty(),
        "relations": search.fitted.as_ref().map(|fitted| relations(ansatz, fitted)),
        "evidence": search.fitted.as_ref().map(evidence),
        "loops": search.curves.as_ref().map(loops),
        "symmetries": search.mobile_slices.iter().map(slice).collect::<Vec<_>>(),
        "rounded": ansatz.rounded,
    })
}

fn relations(ansatz: &Ansatz, fitted: &Fitted) -> Vec<String> {
    fitted.sweep.relations.iter().map(|relation| polynomial(ansatz, relation)).collect()
}

fn evidence(fitted: &Fitted) -> Value {
    let sweep = |evidence: &Evidence| {
        json!({
            "prime": evidence.prime, "draws": evidence.draws, "members": evidence.members, "relations": evidence.relations,
        })
    };
    json!({
        "terms": fitted.sweep.terms,
        "sweeps": fitted.sweep.evidence.iter().map(sweep).collect::<Vec<_>>(),
        "trial": fitted.sweep.trial.map(|trial| json!({
            "prime": trial.prime, "on": trial.on, "mobile_on": trial.mobile_on, "off": trial.off, "mobile_off": trial.mobile_off,
        })),
        "closed_positions": fitted.closed.map(|closed| json!({ "found": closed.positions, "satisfied": closed.satisfied })),
        "member": fitted.member.as_ref().map(|member| local(&member.germ)),
        "family_proof": fitted.is_proved(),
    })
}

fn loops(curves: &CurveSearch) -> Value {
    let found = |found: &CurveLoop| {
        json!({
            "lengths": lengths(&found.lengths),
            "ties": found.curves.iter().map(tie).collect::<Vec<_>>(),
            "degenerate": degenerate(found),
            "local": local(&found.germ),
        })
    };
    json!({
        "tan_half_alpha": curves.twists.iter().map(ToString::to_string).collect::<Vec<_>>(),
        "found": curves.loops.iter().map(found).collect::<Vec<_>>(),
    })
}

/// The relations that were fitted, in the language of another program.
///
/// # Errors
/// Where none was, or the language has no way to say it.
pub fn system(ansatz: &Ansatz, search: &Search, format: Format) -> crate::error::Result<String> {
    let relations = search.fitted.as_ref().map_or(&[][..], |fitted| &fitted.sweep.relations);
    if relations.is_empty() {
        return Err(crate::error::Error::Unsupported("no relation was fitted that could be written".to_owned()));
    }
    format.system(relations, ansatz.symbols.names())
}
