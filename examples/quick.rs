use looproot::assembly::*;
use looproot::kinematics::{closed_loop::*, motion::Motion};
use std::time::Instant;
fn main() {
    let mut s = 12345u64;
    let mut rnd = move || { s ^= s << 13; s ^= s >> 7; s ^= s << 17; (s >> 11) as f64 / (1u64 << 53) as f64 * 2.0 - 1.0 };
    let mut hist = [0usize; 20]; let mut total16 = 0; let mut cert16 = 0; let mut lost = 0; let mut tries = 0; let mut worst: f64 = 0.0; let mut clean=0;
    let n = 2000;
    let mut ws = Workspace::default(); let mut asm = Assembly::default();
    let (mut tp, mut ta, mut tr) = (0.0, 0.0, 0.0); let mut lostr=0;
    let pi = std::f64::consts::PI;
    for _ in 0..n {
        let links: Vec<Motion<f64>> = (0..6).map(|_| { let (a,d,al)=(rnd(),rnd(),rnd()*pi); let mut m = Motion::rotation_x(al.cos(), al.sin()); m.translation=[a,0.0,d]; m}).collect();
        let q: Vec<f64> = (0..6).map(|_| rnd()*pi).collect();
        let mut h = Motion::identity();
        for k in 0..6 { h = h.then_after(&Motion::rotation_z(q[k].cos(), q[k].sin())).then_after(&links[k]); }
        let open = OpenLoop { variables: [Variable::Rotation;6], constants: std::array::from_fn(|k| links[k].clone()), before_gap: links[5].clone(), after_gap: Motion::identity() };
        let t0 = Instant::now();
        let solver = Solver::prepare(&open);
        let t1 = Instant::now();
        let hi = h.inverse();
        solver.solve(&hi, Roots::Real, &mut ws, &mut asm);
        let t2 = Instant::now();
        let found = |asm: &Assembly| asm.modes.iter().any(|m| m.real && (0..6).all(|k| wrapped(m.unknowns[k].re - q[k]).abs() < 1e-6));
        if !found(&asm) { lostr += 1; }
        let t3 = Instant::now();
        solver.solve(&hi, Roots::All, &mut ws, &mut asm);
        let t4 = Instant::now();
        tp += (t1-t0).as_secs_f64(); tr += (t2-t1).as_secs_f64(); ta += (t4-t3).as_secs_f64();
        if !found(&asm) { lost += 1; }
        hist[asm.real()] += 1;
        if asm.total()==16 { total16 += 1; }
        if asm.clean { clean+=1; }
        if asm.modes.iter().filter(|m| m.certificate.is_some()).count()==16 { cert16 += 1; }
        tries += asm.tries;
        for m in &asm.modes { worst = worst.max(m.residual); }
    }
    println!("n {n} lost {lost} lost real-route {lostr} total16 {total16} cert16 {cert16} clean {clean} tries {} hist {hist:?} worst {worst:e}", tries as f64/n as f64);
    println!("us: prepare {:.1} real {:.1} all {:.1}", tp/n as f64*1e6, tr/n as f64*1e6, ta/n as f64*1e6);
}
