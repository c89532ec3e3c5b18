//! Examples at the end of the help of every verb.

/// Examples of `solve`.
pub const SOLVE: &str = "\
Examples:
  looproot solve robot.urdf --at \"0.3, 0.1, 0.4; 1, 0, 0, 0\"     every way to reach a pose
  looproot solve robot.urdf --poses poses.csv --jsonl             one answer a line, for as many poses as there are
  looproot solve iiwa.urdf --at \"...\" --lock joint_a3=\"10 deg\"   seven joints, one held
  looproot solve platform.toml --poses poses.csv --inverse        the leg lengths of a platform at every pose";

/// Examples of `derive`.
pub const DERIVE: &str = "\
Examples:
  looproot derive puma560 --pose 1              the closure polynomial of a pose and its real roots
  looproot derive cccr_4_angle --symbolic       with symbols for the link parameters
  looproot derive general_7r --symbolic=a1      with one symbol, by interpolation
  looproot derive loop.toml --explain=latex     the derivation as a paper";

/// Examples of `sweep`.
pub const SWEEP: &str = "\
Examples:
  looproot sweep loop.toml --from 0 --to \"360 deg\"             branches and limit positions
  looproot sweep bennett_a --from 0 --to \"360 deg\" --svg -o bennett.svg
  looproot sweep linkage/coupler_instant --from 0 --to \"360 deg\" --ratio D   a velocity ratio and its extremes
  looproot sweep loop.toml --joint 2 --from 0 --to 1 --csv      one row for every branch and step
  looproot sweep linkage/watt_line --from 0 --to \"360 deg\" --certificate watt.cert   which looproot verify checks
  looproot sweep hexapod --joint leg1 --from \"5 cm\" --to \"8 cm\"   a platform: one leg changes its length";

/// Examples of `view`.
pub const VIEW: &str = "\
Examples:
  looproot view robot.urdf --at \"0.3, 0.1, 0.4; 1, 0, 0, 0\" -o robot.html          every way to reach a pose, in space
  looproot view robot.urdf --at \"0.3, 0.1, 0.4; 1, 0, 0, 0\" --live -o live.html   with sliders, solved anew in the page
  looproot view fourbar.toml --sweep --from 0 --to \"360 deg\" -o fourbar.html      every branch, moving
  looproot view hexapod.toml --svg -o hexapod.svg                                a figure for a paper";

/// Examples of `mobility`.
pub const MOBILITY: &str = "\
Examples:
  looproot mobility bennett_a          does it move, and why
  looproot mobility loop.toml -q       the verdict only
  looproot mobility steffen --json     a framework, as a document";

/// Examples of `factor`.
pub const FACTOR: &str = "\
Examples:
  looproot factor motion/bennett               the factors and the loop they close
  looproot factor motion.toml --pair 1,6       the loop of these two factorisations
  looproot factor motion.toml --toml -o loop.toml";

/// Examples of `synthesize`.
pub const SYNTHESIZE: &str = "\
Examples:
  looproot synthesize burmester5_4real_a                        all dyads through five positions
  looproot synthesize burmester5_4real_a --linkage 2,4 --toml   the four-bar of two of them, as a file
  looproot synthesize burmester4_a --svg -o curves.svg          circle points and centre points
  looproot synthesize nine_points_a --no-defects                all four-bars through nine points
  looproot synthesize seven_positions --near \"0, 3, 1\" --json  the nearest fixed point first, as a document";

/// Examples of `conditions`.
pub const CONDITIONS: &str = "\
Examples:
  looproot conditions 4R                              all loops of four revolutes that move
  looproot conditions loop.toml --explain             with the derivation
  looproot conditions 4R --format sympy --family spherical
  looproot conditions 4R --certificate 4r.cert        which looproot verify checks";

/// Examples of `motion`.
pub const MOTION: &str = "\
Examples:
  looproot motion --from quaternion \"1, 2, 2, 4\" --json          every parametrisation, every branch
  looproot motion --from euler \"10 deg, 20 deg, 30 deg\" --axes zyz
  looproot motion --from motion \"1, 2, 3; 1, 0, 0, 1\" --dual    the screw, and dual angles";

/// Examples of `instant`.
pub const INSTANT: &str = "\
Examples:
  looproot instant linkage/coupler_instant --body coupler
  looproot instant linkage/coupler_instant --body rocker --against crank --json
  looproot instant linkage/coupler_instant --loads \"coupler.C: 0, -10; rocker: 5\"   what holds these loads
  looproot instant bennett_a --body 2                    a loop: the body behind its second joint
  looproot instant puma560 --pose 1 --body 6 --rate \"1,0,0,0,0,0\"
  looproot instant linkage/hooke_series --body cross1    about a point
  looproot instant linkage/rssr_ssr --body rocker2       in space";

/// Examples of `dynamics`.
pub const DYNAMICS: &str = "\
Examples:
  looproot dynamics linkage/weighted_four_bar --rate 2 --forces
  looproot dynamics linkage/weighted_four_bar --time 3 --steps 30 --json";

/// Examples of `list`.
pub const LIST: &str = "\
Examples:
  looproot list                  everything that is built in
  looproot list robots           the arms of makers by name
  looproot list --json";

/// Examples of `verify`.
pub const VERIFY: &str = "\
Exit codes: 0 every item holds, 2 one does not, 1 a certificate cannot be read.

Examples:
  looproot solve puma560 --certificate puma560.cert
  looproot verify puma560.cert --file puma560       the certificate, and that it is about this file
  python3 verify/verify.py puma560.cert             the same by a checker that shares no code with this program";

/// Examples of `show`.
pub const SHOW: &str = "\
Examples:
  looproot show robot.urdf            the axes as they were understood
  looproot show puma560 --source      the text of a built-in entry
  looproot show arm.toml --json";

/// Examples of `convert`.
pub const CONVERT: &str = "\
Examples:
  looproot convert robot.urdf --to toml -o robot.toml     screw axes in the home position
  looproot convert puma560 --to urdf -o puma.urdf         a robot description
  looproot convert kr6_r900 --to opw                      seven lengths as YAML";

/// Examples of `check`.
pub const CHECK: &str = "\
Examples:
  looproot check                       the whole built-in library
  looproot check my/arms/              every file of a folder
  looproot check arm.toml --quiet      failures only";

/// Examples of `completions`.
pub const COMPLETIONS: &str = "\
Examples:
  looproot completions bash > /etc/bash_completion.d/looproot
  looproot completions zsh > ~/.zfunc/_looproot
  looproot completions fish > ~/.config/fish/completions/looproot.fish";
