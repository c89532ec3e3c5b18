//! Solves a loop again from exact constants in 384- or 960-bit arithmetic, for solutions that f64 cannot reach.
//!
//! Nearly special geometry has solutions almost at infinity: angles with large imaginary parts, translations of enormous
//! length. Rounding in f64 loses them. Here the same eliminations lead to the same closure polynomial in numbers with enough
//! digits. All of its roots are found, and each is followed back to all six unknowns, polished and proved.

use super::mode::{Hits, Mode, are_apart, wrapped};
use super::spherical::canonical;
use crate::algebra::determinant::determinant;
use crate::algebra::ring::{Field, Ring};
use crate::algebra::sort;
use crate::algebra::univariate::Univariate;
use crate::certify::{Refined, exponential, exponential_pair, from_pairs};
use crate::elimination::coordinate_ring::{self, CoordinateRing};
use crate::elimination::cut::{Cut, Hidden};
use crate::elimination::degree::{TurnedPencil, turned_pencil};
use crate::elimination::kind::Elimination;
use crate::elimination::octic;
use crate::elimination::rearranged::rearranged;
use crate::elimination::separated::{self, Plan, Separated, powers};
use crate::elimination::spherical_four_bar::FourBar;
use crate::elimination::spherical_triangle::{Triangle, triangle};
use crate::elimination::two_sided::{Known, TwoSided};
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::kinematics::link_form::{LinkForm, product, turned};
use crate::kinematics::motion::Motion;
use crate::solve::back_substitution::CutView;
use crate::solve::hessenberg::Hessenberg;
use crate::solve::kernel::{at_root, kernel};
use crate::solve::newton::{Six, closure_at, product as product_of_steps};
use crate::solve::polynomial_roots::polynomial_roots;
use crate::solve::scalar::{Extended, Number, extended};
use num_complex::Complex;

/// The data of the motions of a loop, per unknown: cosine and sine of an angle, or a distance and 0.
type Pairs<R> = [(Complex<R>, Complex<R>); 6];

/// Maximum number of closure polynomials tried, from other cuts or in other angles, for what nothing else decides.
pub const MOST_TRIES: usize = 6;

/// Finds and proves the solutions of a loop with exact constants, with lengths over the scale of the solver. Returns the
/// modes, conjugates included, of the first closure polynomial that leads to `expected` of them, or else of the one that
/// leads to most. If the coordinate ring has a plan, the ring is tried after the first polynomial.
pub(super) fn solve_in_high_precision<R: Extended>(
    exact: &ClosedLoop<R>,
    spherical: Option<usize>,
    plan: Option<&coordinate_ring::Plan>,
    expected: usize,
    most_tries: usize,
) -> Vec<Mode> {
    let mut best = Vec::new();
    let mut note = |candidates: &[Pairs<R>]| {
        let modes = modes(exact, spherical, candidates);
        if modes.len() > best.len() {
            best = modes;
        }
        best.len() >= expected
    };
    let by_ring = || eigenvectors(&plan?.ring(exact)?);
    let mut tries = 0;
    let mut take = |candidates: Vec<Pairs<R>>| {
        tries += 1;
        note(&candidates) || (tries == 1 && by_ring().is_some_and(|all| note(&all))) || tries >= most_tries
    };
    let special = TwoSided::of(exact, spherical, R::PIVOT_ZERO).and_then(|way| two_sided(exact, way));
    if !special.is_some_and(&mut take) {
        match Elimination::of(exact.variables, spherical) {
            Elimination::Centre(_) => {}
            Elimination::Triangle => _ = take(spherical_triangle(exact).unwrap_or_default()),
            Elimination::FourBar => four_bars(exact, &mut take),
            Elimination::Cut | Elimination::Planar => cuts(exact, &mut take),
        }
    }
    if tries == 0
        && let Some(all) = by_ring()
    {
        note(&all);
    }
    best
}

/// Finds and proves the simple solutions of a loop at which the zero unknowns of a plan vanish, from exact constants.
/// Conjugates are included.
#[must_use]
pub fn by_ring<R: Extended>(exact: &ClosedLoop<R>, plan: &coordinate_ring::Plan) -> Vec<Mode> {
    let candidates = plan.ring(exact).and_then(|ring| eigenvectors(&ring));
    modes(exact, None, &candidates.unwrap_or_default())
}

/// Returns a loop over complex numbers.
fn complex<R: Extended>(closed: &ClosedLoop<R>) -> ClosedLoop<Complex<R>> {
    let lift = |motion: &Motion<R>| Motion {
        rotation: motion.rotation.map(|row| row.map(Complex::from_real)),
        translation: motion.translation.map(Complex::from_real),
    };
    ClosedLoop { variables: closed.variables, constants: closed.constants.each_ref().map(lift) }
}

/// Returns the roots on and above the real axis; the others are their conjugates.
fn upper_roots<R: Extended>(polynomial: &Univariate<R>) -> Option<Vec<Complex<R>>> {
    let roots = polynomial_roots(polynomial)?.into_iter().filter_map(|root| {
        let real = root.im.size() <= R::UNIT_ROUNDOFF.sqrt() * (1.0 + root.size());
        let kept = if real { Complex::new(root.re, R::zero()) } else { root };
        (real || root.im.to_f64() > 0.0).then_some(kept)
    });
    Some(roots.collect())
}

/// Returns the monomials of a variable at a root: (1, cos, sin) of an angle counted from the offset, (1, d, d^2) of a distance.
/// `None` at a half tangent of +-i.
fn monomials<R: Extended>(variable: Variable, root: &Complex<R>) -> Option<[Complex<R>; 3]> {
    let powers = powers::<R>(variable, &separated::offset());
    let at = |row: &[R; 3]| row.iter().rev().fold(Complex::zero(), |sum, c| sum.mul(root).add(&Complex::from_real(*c)));
    let [one, first, second] = powers.each_ref().map(at);
    let inverse = one.inverse()?;
    Some([Complex::one(), first.mul(&inverse), second.mul(&inverse)])
}

/// Returns `row . monomials`.
fn weighted<R: Extended>(row: &[R; 3], monomials: &[Complex<R>; 3]) -> Complex<R> {
    row.iter().zip(monomials).fold(Complex::zero(), |sum, (c, m)| sum.add(&m.times(*c)))
}

/// Returns both sides of two separated equations at their solutions.
fn both_sides<R: Extended>(equations: &Separated<R>) -> Option<Vec<[[Complex<R>; 3]; 2]>> {
    let Plan::Together { hidden, other } = equations.plan(R::PIVOT_ZERO) else { return None };
    let polynomial = separated::closure_polynomial(equations, hidden, &other);
    let sides = upper_roots(&polynomial)?.into_iter().filter_map(|root| {
        let known = monomials(equations.kinds[hidden], &root)?;
        let other = other.each_ref().map(|row| weighted(row, &known));
        Some(if hidden == 0 { [known, other] } else { [other, known] })
    });
    Some(sides.collect())
}

/// Returns the solutions of a loop with three rotations.
fn spherical_triangle<R: Extended>(exact: &ClosedLoop<R>) -> Option<Vec<Pairs<R>>> {
    let (form, lifted) = (LinkForm::<_, 3, 3>::of(exact)?, LinkForm::of(&complex(exact))?);
    let real = triangle(&form);
    let powers = powers(Variable::Rotation, &separated::offset());
    let coefficient = |l: usize| (0..3).fold(R::zero(), |sum, k| sum.add(&real.equation[k].mul(&powers[k][l])));
    let polynomial = Univariate::new((0..3).map(coefficient).collect());
    let triangle = Triangle { dropped: real.dropped, equation: real.equation.map(Complex::from_real) };
    let candidates = upper_roots(&polynomial)?.into_iter().filter_map(|root| {
        let [_, cos, sin] = monomials(Variable::Rotation, &root)?;
        lifted.unknowns_at(&triangle.rotations(&lifted, &(cos, sin))?)
    });
    Some(candidates.collect())
}

/// Passes the solutions of a loop with four rotations to `take`.
fn four_bars<R: Extended>(exact: &ClosedLoop<R>, take: &mut impl FnMut(Vec<Pairs<R>>) -> bool) {
    let (Some(form), Some(lifted)) = (LinkForm::<_, 4, 2>::of(exact), LinkForm::<_, 4, 2>::of(&complex(exact))) else {
        return;
    };
    let mut bases = [0, 1, 2, 3];
    let twist = |base: usize| form.twist(base + 2).0.to_f64();
    sort::by(&mut bases, |&a, &b| twist(b).total_cmp(&twist(a)));
    for base in bases {
        let (Some(bar), Some(complex_bar)) = (FourBar::new(&form, base), FourBar::new(&lifted, base)) else { continue };
        let equations = bar.equations();
        for hidden in [Hidden::First, Hidden::Second] {
            let polynomial = octic::closure_polynomial(&equations, hidden, &separated::offset());
            let Some(roots) = upper_roots(&polynomial) else { continue };
            let candidates = roots.iter().filter_map(|root| {
                let known = monomials(Variable::Rotation, root)?;
                let row = |form: &[[R; 3]; 3]| -> [Complex<R>; 3] {
                    std::array::from_fn(|l| {
                        let at = |k: usize| if hidden == Hidden::First { form[k][l] } else { form[l][k] };
                        weighted(&std::array::from_fn(at), &known)
                    })
                };
                let (f, g) = (row(&equations.f), row(&equations.g));
                let minor = |i: usize, j: usize| f[i].mul(&g[j]).sub(&f[j].mul(&g[i]));
                let inverse = minor(1, 2).inverse()?;
                let other = (minor(2, 0).mul(&inverse), minor(0, 1).mul(&inverse));
                let known = (known[1], known[2]);
                let (a, b) = if hidden == Hidden::First { (known, other) } else { (other, known) };
                lifted.unknowns_at(&complex_bar.rotations(&a, &b))
            });
            if take(candidates.collect()) {
                return;
            }
        }
    }
}

/// Solves a loop with five or six rotations, cut after cut, the loop as it is first.
fn cuts<R: Extended>(exact: &ClosedLoop<R>, take: &mut impl FnMut(Vec<Pairs<R>>) -> bool) {
    let as_it_is = (exact.clone(), [0, 1, 2, 3, 4, 5], false);
    let moved = rearranged(exact, R::PIVOT_ZERO).into_iter().map(|m| (m.closed, m.order, m.flipped));
    for (closed, order, flipped) in std::iter::once(as_it_is).chain(moved) {
        for (cut, hidden, _) in Cut::hidings() {
            let Some(candidates) = one_cut(&closed, cut, hidden) else { continue };
            let candidates = candidates.into_iter().map(|of_cut| {
                let mut pairs = [(Complex::zero(), Complex::zero()); 6];
                for (j, (first, second)) in of_cut.into_iter().enumerate() {
                    let index = cut.unknown_index(j);
                    pairs[order[index]] = match closed.variables[index] {
                        Variable::Rotation if cut.reversed => (first, second.neg()),
                        Variable::Translation if cut.reversed != flipped => (first.neg(), second),
                        _ => (first, second),
                    };
                }
                pairs
            });
            if take(candidates.collect()) {
                return;
            }
        }
    }
}

/// Returns the candidates of one cut, with the unknowns in the order of the cut.
fn one_cut<R: Extended>(closed: &ClosedLoop<R>, cut: Cut, hidden: Hidden) -> Option<Vec<Pairs<R>>> {
    let TurnedPencil { view, form, pencil } = turned_pencil(closed, cut, hidden)?;
    let value = |k: i32| {
        let x = R::from_integer(k - 8);
        let [a0, a1, a2] = &pencil.coefficients;
        let at = |i: usize, j: usize| a2[i][j].mul(&x).add(&a1[i][j]).mul(&x).add(&a0[i][j]);
        let matrix: [[R; 8]; 8] = std::array::from_fn(|i| std::array::from_fn(|j| at(i, j)));
        (x, determinant(&matrix))
    };
    let polynomial = Univariate::interpolate(&(0..=16).map(value).collect::<Vec<_>>());
    let back = CutView::<Complex<R>>::new(&view, &form, hidden);
    let candidates = upper_roots(&polynomial)?.into_iter().filter_map(|root| {
        let [_, cos, sin] = monomials(Variable::Rotation, &root)?;
        back.pairs_of((cos, sin), &kernel(&at_root(&pencil, root), 0.0).basis[0])
    });
    Some(candidates.collect())
}

/// Weights of the combination of cosines, sines and distances whose eigenvalues are computed. As a rule no two solutions
/// share its value.
const WEIGHTS: [i32; 10] = [3, -5, 7, 11, -13, 17, 19, -23, 29, 31];

/// Returns the solutions by the eigenvectors of a product in the ring of the loop.
fn eigenvectors<R: Extended>(ring: &CoordinateRing<R>) -> Option<Vec<Pairs<R>>> {
    let (first, closed) = ring.view();
    let (one, unknowns) = ring.unknowns();
    let hessenberg = Hessenberg::of(ring.multiplication(&WEIGHTS.map(R::from_integer)));
    let candidates = upper_roots(&hessenberg.characteristic())?.into_iter().filter_map(|root| {
        let values = hessenberg.vector(&root)?;
        let at = |row: &[R]| row.iter().zip(&values).fold(Complex::zero(), |sum, (c, v)| sum.add(&v.times(*c)));
        let unit = at(&one).inverse()?;
        let known = unknowns.each_ref().map(|[x, y]| (at(x).mul(&unit), at(y).mul(&unit)));
        // V6 = (G6 V1 G1 ... V5 G5)^-1, a rotation about z.
        let frame = product_of_steps::<Complex<R>>(closed, &known, 5).rotation;
        let g = &closed.constants[5].rotation;
        let entry = |j: usize| (0..3).fold(Complex::zero(), |sum, k| sum.add(&frame[k][j].times(g[0][k])));
        let sixth = (entry(0), entry(1));
        let mut pairs = [(Complex::zero(), Complex::zero()); 6];
        for (k, pair) in known.into_iter().chain([sixth]).enumerate() {
            pairs[(first + k) % 6] = pair;
        }
        Some(pairs)
    });
    Some(candidates.collect())
}

/// Returns the candidates by two equations with an unknown on either side.
fn two_sided<R: Extended>(exact: &ClosedLoop<R>, way: TwoSided) -> Option<Vec<Pairs<R>>> {
    let lifted = complex(exact);
    let sides = both_sides(&way.equations(exact)?)?;
    Some(sides.iter().filter_map(|sides| completed(&lifted, &way.known(&lifted, sides.each_ref())?)).collect())
}

/// Adds the three rotations of a spherical joint, if there is one, to the other unknowns.
fn completed<R: Extended>(lifted: &ClosedLoop<Complex<R>>, known: &Known<Complex<R>>) -> Option<Pairs<R>> {
    let mut pairs = known.map(|pair| pair.unwrap_or((Complex::zero(), Complex::zero())));
    let Some(spherical) = (0..6).find(|k| known[*k].is_none() && known[(k + 5) % 6].is_some()) else {
        return Some(pairs);
    };
    let mut rest = lifted.constants[(spherical + 2) % 6].rotation;
    for k in [3, 4, 5].map(|k| (spherical + k) % 6) {
        if lifted.variables[k] == Variable::Rotation {
            rest = turned(&rest, &pairs[k]);
        }
        rest = product(&rest, &lifted.constants[k].rotation);
    }
    // Rz(a) Rx(b) Rz(c) is the inverse.
    let r = |i: usize, j: usize| rest[j][i];
    let sin = r(0, 2).mul(&r(0, 2)).add(&r(1, 2).mul(&r(1, 2))).root();
    let inverse = sin.inverse()?;
    pairs[spherical] = (r(1, 2).neg().mul(&inverse), r(0, 2).mul(&inverse));
    pairs[(spherical + 1) % 6] = (r(2, 2), sin);
    pairs[(spherical + 2) % 6] = (r(2, 1).mul(&inverse), r(2, 0).mul(&inverse));
    Some(pairs)
}

/// Returns the residual of unknowns rounded to f64, see [`Mode::residual`]. Computing it in f64 would add rounding errors.
fn residual<R: Extended>(exact: &ClosedLoop<R>, unknowns: &Six<Complex<f64>>, real: bool) -> f64 {
    let mut pairs = [(Complex::zero(), Complex::zero()); 6];
    for (j, pair) in pairs.iter_mut().enumerate() {
        *pair = match exact.variables[j] {
            Variable::Translation => (extended(unknowns[j]), Complex::zero()),
            Variable::Rotation => exponential_pair(exponential(unknowns[j])).unwrap_or(*pair),
        };
    }
    let here = closure_at::<Complex<R>>(exact, &pairs);
    here.relative_defect(exact, unknowns, real)
}

/// Returns the modes that are proved among the candidates, each once, conjugates included.
fn modes<R: Extended>(exact: &ClosedLoop<R>, spherical: Option<usize>, candidates: &[Pairs<R>]) -> Vec<Mode> {
    let mut modes: Vec<Mode> = Vec::new();
    for Refined { unknowns, real, certificate, condition } in candidates.iter().filter_map(|p| from_pairs(exact, p)) {
        let mut add = |mut unknowns: Six<Complex<f64>>| {
            for (z, variable) in unknowns.iter_mut().zip(exact.variables) {
                if variable == Variable::Rotation {
                    z.re = wrapped(z.re);
                }
            }
            if let Some(spherical) = spherical {
                canonical(&mut unknowns, spherical);
            }
            let mode = Mode {
                unknowns,
                real,
                multiplicity: 1,
                residual: residual(exact, &unknowns, real),
                condition,
                certificate: Some(certificate),
                hits: Hits::first(usize::MAX),
            };
            if modes.iter().all(|other| are_apart(&exact.variables, other, &mode)) {
                modes.push(mode);
            }
        };
        add(unknowns);
        if !real {
            add(unknowns.map(|z| z.conj()));
        }
    }
    modes
}
