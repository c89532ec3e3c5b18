//! The 6R loops of docs/bennett_dyads.md: random members move, members with one condition broken do not.
#![allow(clippy::unwrap_used)]

use looproot::internal::catalogue::{Format, Options, load_text};
use looproot::internal::mobility::{Mobility, mobility};
use looproot::internal::verdict::Proof;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rug::Rational;

type Complex = (Rational, Rational);

/// Half-angle tangents of the twists, lengths and offsets.
struct Member {
    tangents: [Rational; 6],
    lengths: [Rational; 6],
    offsets: [Rational; 6],
}

fn one() -> Rational {
    Rational::from(1)
}

fn product(x: &Complex, y: &Complex) -> Complex {
    (
        Rational::from(&x.0 * &y.0) - Rational::from(&x.1 * &y.1),
        Rational::from(&x.0 * &y.1) + Rational::from(&x.1 * &y.0),
    )
}

fn quotient(x: &Complex, y: &Complex) -> Complex {
    let norm = Rational::from(y.0.square_ref()) + Rational::from(y.1.square_ref());
    product(x, &(Rational::from(&y.0 / &norm), -Rational::from(&y.1 / &norm)))
}

fn cosine(t: &Rational) -> Rational {
    let square = Rational::from(t.square_ref());
    (one() - &square) / (one() + square)
}

fn sine(t: &Rational) -> Rational {
    Rational::from(t * 2) / (one() + Rational::from(t.square_ref()))
}

/// The family by its eight parameters: t1, t2, t4, t3, t6, b, chi, kappa.
fn member([t1, t2, t4, t3, t6, b, chi, kappa]: &[Rational; 8]) -> Member {
    let t5 = Rational::from(t1 * t2) / t4;
    let mut number = (Rational::from(b * 2), Rational::new());
    for factor in [t4, &t5, chi, kappa] {
        number = product(&number, &(one(), factor.clone()));
    }
    for factor in [t1, t2, t3, t6, &Rational::from(-kappa)] {
        number = quotient(&number, &(one(), factor.clone()));
    }
    let (mu, wqq) = number;
    let other = b * sine(t1) * sine(t2) / (sine(t4) * sine(&t5));
    let (c3, c6) = (cosine(t3), cosine(t6));
    let w = wqq / ((one() + &c3) * (one() + &c6));
    let omega = &w * (Rational::from(&c6 - &c3) / 2);
    let turned = w * (one() + Rational::from(&c3 + &c6) / 2);
    let first = -Rational::from(b * chi) - &turned;
    let second = -Rational::from(&other * chi) - turned;
    Member {
        lengths: [b * sine(t1), b * sine(t2), Rational::from(&mu * t3), &other * sine(t4), &other * sine(&t5), mu * t6],
        offsets: [
            Rational::from(&first + &omega),
            Rational::new(),
            first - &omega,
            Rational::from(&second - &omega),
            Rational::new(),
            second + omega,
        ],
        tangents: [t1.clone(), t2.clone(), t3.clone(), t4.clone(), t5, t6.clone()],
    }
}

fn decided(member: &Member) -> Mobility {
    let joints = (0..6)
        .map(|k| {
            let (t, a, d) = (&member.tangents[k], &member.lengths[k], &member.offsets[k]);
            format!("{{ type = \"R\", a = \"{a}\", tan_half_alpha = \"{t}\", d = \"{d}\" }}")
        })
        .collect::<Vec<_>>()
        .join(",\n");
    let text = format!("[mechanism]\nkind = \"loop\"\nconvention = \"dh\"\njoints = [\n{joints},\n]\n");
    mobility(&load_text(&text, "member.toml", Format::Toml, &Options::default()).unwrap()).unwrap()
}

#[test]
fn random_members_move_and_broken_ones_do_not() {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let (mut moving, mut complex) = (0, 0);
    while moving < 6 {
        let parameters: [Rational; 8] = std::array::from_fn(|_| {
            let sign = if random.random_bool(0.5) { 1 } else { -1 };
            Rational::from((sign * random.random_range(1..=4), random.random_range(1..=4)))
        });
        let member = member(&parameters);
        if cosine(&member.tangents[2]) == cosine(&member.tangents[5]) {
            continue;
        }
        let answer = decided(&member);
        if answer.configurations.is_empty() {
            // No real position.
            complex += 1;
            assert!(complex < 6, "members without a real position should be rare");
            continue;
        }
        assert_eq!((answer.mobility, answer.proof), (Some(1), Proof::Proved), "{parameters:?}");
        assert_eq!(answer.screw_rank(), Some(5), "{parameters:?}");
        let joint = 2 * random.random_range(0..3);
        let mut broken = member;
        broken.offsets[joint] += Rational::from((1, 100));
        assert_eq!(decided(&broken).mobility, Some(0), "{parameters:?} with another d{}", joint + 1);
        moving += 1;
    }
}
