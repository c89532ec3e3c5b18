#!/usr/bin/env python3
"""Runs the jobs of jobs/ in looproot, FLINT, Symbolica and PARI, one process each, and prints docs/algebra.md's table.

    cargo build --release
    python3 -m venv venv && venv/bin/pip install python-flint symbolica      # and PARI: apt-get install pari-gp
    venv/bin/python benches/algebra/compare.py [JOB ...] [--rounds 3] [--only looproot,flint,symbolica,pari]

Each process times its job itself: the least wall time of up to 300 runs of a short job, the median processor time of a
long one. looproot's time includes reading: texts to numbers and polynomials, clearing denominators. The others start
from their own finished structures. Of several rounds the least time counts. Results are compared modulo a prime, up to
sign; a disagreement ends the comparison.
"""
import argparse, ctypes, glob, json, os, re, shutil, signal, subprocess, sys, time
from pathlib import Path

HERE = Path(__file__).resolve().parent
PROGRAM = os.environ.get("LOOPROOT", str(HERE.parent.parent / "target/release/looproot"))
PRIME = 1_000_000_007
POINTS = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59, 61, 67, 71, 73, 79, 83, 89, 97]
PEERS = ["looproot", "flint", "symbolica", "pari"]


def load(job):
    return json.loads((HERE / "jobs" / f"{job}.json").read_text())


def timed(run, budget=1.5):
    """The result, and the seconds: least wall time of short runs, median processor time of long ones."""
    walls, cpus, start = [], [], time.perf_counter()
    while True:
        # Very short runs are repeated until they take 0.1 ms together.
        count = max(1, min(1000, int(1e-4 / min(walls)))) if walls else 1
        cpu, wall = time.process_time(), time.perf_counter()
        for _ in range(count):
            result = run()
        walls.append((time.perf_counter() - wall) / count)
        cpus.append((time.process_time() - cpu) / count)
        if time.perf_counter() - start > budget or len(walls) >= (300 if min(walls) < 0.02 else 25):
            break
    return result, min(walls) if min(walls) < 0.02 else sorted(cpus)[len(cpus) // 2]


def tell(seconds, terms, value):
    print("T", repr(seconds))
    print("TERMS", terms)
    print("VAL", value)


def rows_of_integers(matrix):
    """The rows of a matrix of rational coefficient lists times their common denominators, and the product of those."""
    from fractions import Fraction
    from math import lcm
    rows, scale = [], 1
    for row in matrix:
        entries = [[Fraction(c) for c in entry] for entry in row]
        common = lcm(*(c.denominator for entry in entries for c in entry))
        rows.append([[int(c * common) for c in entry] for entry in entries])
        scale *= common
    return rows, scale


# ---------------------------------------------------------------------------------------------------------- FLINT

def flint_library():
    import flint
    folder = Path(flint.__file__).parent.parent / "python_flint.libs"
    return ctypes.CDLL(glob.glob(str(folder / "libflint-*.so*"))[0])


def flint_determinant(job):
    """The faster of FLINT's two determinants of matrices over Z[x], called in the library that python-flint brings."""
    library = flint_library()
    rows, scale = rows_of_integers(job["M"])
    size = ctypes.c_long(len(rows))
    matrix, result = (ctypes.c_long * 16)(), (ctypes.c_long * 4)()
    library.fmpz_poly_mat_init(matrix, size, size)
    library.fmpz_poly_mat_entry.restype = ctypes.c_void_p
    library.fmpz_poly_get_str.restype = ctypes.c_char_p
    for i, row in enumerate(rows):
        for j, entry in enumerate(row):
            text = f"{len(entry)}  {' '.join(map(str, entry))}".encode()
            place = library.fmpz_poly_mat_entry(matrix, ctypes.c_long(i), ctypes.c_long(j))
            library.fmpz_poly_set_str(ctypes.c_void_p(place), text)
    library.fmpz_poly_init(result)
    functions = [library.fmpz_poly_mat_det_interpolate, library.fmpz_poly_mat_det]
    seconds = min(timed(lambda: function(result, matrix))[1] for function in functions)
    coefficients = [int(c) for c in library.fmpz_poly_get_str(result).split()[1:]]
    value = sum(c * 2**k for k, c in enumerate(coefficients))
    tell(seconds, sum(c != 0 for c in coefficients), f"{value}/{scale}")


def flint_determinant_of_symbols(job):
    """The determinant of a matrix over Z[x, y, ...] by FLINT's generic rings."""
    library, size = flint_library(), len(job["M"])
    context, matrix = (ctypes.c_long * 64)(), (ctypes.c_long * 16)()
    library.gr_ctx_init_fmpz_mpoly(context, ctypes.c_long(len(job["vars"])), 0)
    names = (ctypes.c_char_p * len(job["vars"]))(*[v.encode() for v in job["vars"]])
    library.gr_ctx_set_gen_names(context, names)
    library.gr_mat_init(matrix, ctypes.c_long(size), ctypes.c_long(size), context)
    library.gr_mat_entry_ptr.restype = library.gr_heap_init.restype = ctypes.c_void_p
    for i, row in enumerate(job["M"]):
        for j, entry in enumerate(row):
            place = library.gr_mat_entry_ptr(matrix, ctypes.c_long(i), ctypes.c_long(j), context)
            if library.gr_set_str(ctypes.c_void_p(place), entry.encode(), context):
                sys.exit(f"FLINT does not read {entry}")
    result = ctypes.c_void_p(library.gr_heap_init(context))
    seconds = []
    for name in ["gr_mat_det", "gr_mat_det_cofactor", "gr_mat_det_berkowitz", "gr_mat_det_fflu"]:
        if name == "gr_mat_det_cofactor" and size > 8:
            continue
        status, s = timed(lambda: getattr(library, name)(result, matrix, context))
        if status == 0:
            seconds.append(s)
    text = ctypes.c_char_p()
    library.gr_get_str(ctypes.byref(text), result, context)
    terms = re.findall(r"[+-]?[^+-]+", text.value.decode().replace(" ", ""))
    values = dict(zip(job["vars"], POINTS))
    tell(min(seconds), len(terms), sum(evaluated(term, values) for term in terms))


def flint_real_roots(job):
    """FLINT's isolation of the real roots, all of which must be simple, without what the call from Python takes."""
    import flint
    library = flint_library()
    x = flint.fmpz_poly([0, 1])
    p = flint.fmpz_poly([int(c) for c in job["coefficients"]]) if "coefficients" in job else evaluated(job["poly"], {"x": x})
    degree = p.degree()
    poly = (ctypes.c_long * 4)()
    library.fmpz_poly_init(poly)
    text = f"{degree + 1}  {' '.join(str(p[k]) for k in range(degree + 1))}".encode()
    if library.fmpz_poly_set_str(poly, text):
        sys.exit("FLINT does not read the polynomial")
    # Fractions 0/1, numerators 0, exponents.
    exact = (ctypes.c_long * (2 * degree))(*[0, 1] * degree)
    numerators, exponents = (ctypes.c_long * degree)(), (ctypes.c_long * degree)()
    points, intervals = ctypes.c_long(), ctypes.c_long()
    arguments = (exact, ctypes.byref(points), numerators, exponents, ctypes.byref(intervals), poly)
    _, call = timed(lambda: library.flint_get_num_threads(*arguments), 0.2)
    _, seconds = timed(lambda: library.fmpz_poly_isolate_real_roots(*arguments))
    real = points.value + intervals.value
    tell(seconds - call, real, real)


def flint_job(job):
    import flint
    kind = job["kind"]
    if kind == "mpolydet":
        return flint_determinant_of_symbols(job)
    if kind == "polydet":
        return flint_determinant(job)
    if kind == "roots":
        return flint_real_roots(job)
    # Texts with fractions are polynomials over Q.
    rational = any("/" in job.get(key, "") for key in ("f", "g", "expr"))
    contexts = flint.fmpq_mpoly_ctx if rational else flint.fmpz_mpoly_ctx
    context = contexts.get(job["vars"], flint.Ordering.lex)
    names = dict(zip(job["vars"], context.gens()))
    if kind in ("mul", "res", "gcd"):
        f, g = evaluated(job["f"], names), evaluated(job["g"], names)
        run = {"mul": lambda: f * g, "res": lambda: f.resultant(g, job["elim"]), "gcd": lambda: f.gcd(g)}[kind]
        if len(job["vars"]) == 1:
            # FLINT's dense polynomials in one variable, where they are faster.
            dense = {job["vars"][0]: (flint.fmpq_poly if rational else flint.fmpz_poly)([0, 1])}
            u, v = evaluated(job["f"], dense), evaluated(job["g"], dense)
            others = {"mul": lambda: u * v, "gcd": lambda: u.gcd(v)}.get(kind, run)
            run = min(run, others, key=lambda run: timed(run, 0.3)[1])
    else:
        def run():
            p = evaluated(job["expr"], names)
            for _ in range(job.get("times", 0) if job.get("div") else 0):
                p = divmod(p, evaluated(job["div"], names))[0]
            return p
    p, seconds = timed(run, 6 if kind == "mul" else 1.5)
    terms = len(p) if hasattr(p, "terms") else sum(c != 0 for c in p.coeffs())
    tell(seconds, terms, p(*POINTS[:len(job["vars"])]))


def evaluated(text, names):
    """The value of a text; a sum of many plain terms by halves, for Python's parser does not nest as deeply as such sums."""
    terms = [] if "(" in text else re.findall(r"[+-]?[^+-]+", text)
    if len(terms) > 200:
        half = len(terms) // 2
        return evaluated("".join(terms[:half]), names) + evaluated("".join(terms[half:]), names)
    if "/" in text:
        import flint
        text, names = re.sub(r"(\d+)/(\d+)", r"Q(\1, \2)", text), dict(names, Q=flint.fmpq)
    return eval(text.replace("^", "**"), {"__builtins__": {}}, names)


# ------------------------------------------------------------------------------------------------------ Symbolica

def symbolica_job(job):
    from symbolica import E, Matrix
    kind = job["kind"]
    if kind == "polydet":
        entry = lambda c: E("+".join(f"({a})*x^{k}" for k, a in enumerate(c))).to_rational_polynomial()
        matrix = Matrix.from_nested([[entry(c) for c in row] for row in job["M"]])
        p, seconds = timed(matrix.det)
        return tell(seconds, job["deg"] + 1, str(p.to_expression().replace(E("x"), E("2")).expand()))
    if kind == "roots":
        text = job.get("poly") or "+".join(f"({c})*x^{k}" for k, c in enumerate(job["coefficients"]))
        p = E(text).expand().to_polynomial()
        # The answer is remembered inside: only the first call counts.
        start = time.process_time()
        roots = p.isolate_real_roots()
        return tell(time.process_time() - start, len(roots), len(roots))
    names = [E(v) for v in job["vars"]]
    polynomial = lambda text: E(text).expand().to_polynomial(vars=names)
    if kind in ("mul", "res", "gcd"):
        f, g = polynomial(job["f"]), polynomial(job["g"])
        run = {"mul": lambda: f * g, "res": lambda: f.resultant(g, E(job["elim"])), "gcd": lambda: f.gcd(g)}[kind]
    elif kind == "mpolydet":
        matrix = Matrix.from_nested([[E(entry).to_rational_polynomial() for entry in row] for row in job["M"]])
        run = matrix.det
    else:
        def run():
            p = E(job["expr"]).to_polynomial(vars=names)
            for _ in range(job.get("times", 0) if job.get("div") else 0):
                p = p.quot_rem(polynomial(job["div"]))[0]
            return p
    p, seconds = timed(run, 6 if kind == "mul" else 1.5)
    p = p.numerator() if kind == "mpolydet" else p
    value = ""
    # Products are long, and a greatest common divisor is known up to a rational factor here.
    if kind not in ("mul", "gcd"):
        e = p.to_expression()
        for name, point in zip(job["vars"], POINTS):
            e = e.replace(E(name), E(str(point)))
        value = str(e.expand())
    tell(seconds, p.nterms() if hasattr(p, "nterms") else len(p.coefficient_list()), value)


# ----------------------------------------------------------------------------------------------------------- PARI

def pari_job(job):
    # Long names for our own variables: a job may use any short one.
    kind, names = job["kind"], job.get("vars", ["x"])
    at = "".join(f"answer=subst(answer,{v},{p});" for v, p in zip(names, POINTS))
    if kind == "polydet":
        entry = lambda c: "+".join(f"({a})*x^{k}" for k, a in enumerate(c))
        matrix = "[" + ";".join(",".join(entry(c) for c in row) for row in job["M"]) + "]"
        given, run, value = f"given={matrix};", "matdet(given)", "subst(answer,x,2)"
    elif kind == "mpolydet":
        matrix = "[" + ";".join(",".join(row) for row in job["M"]) + "]"
        given, run, value = f"given={matrix};", "matdet(given)", "answer"
    elif kind == "roots":
        text = job.get("poly") or "+".join(f"({c})*x^{k}" for k, c in enumerate(job["coefficients"]))
        given, run, value = f"first={text};", "polrootsreal(first)", "#answer"
    elif kind == "res":
        given, run = f"first={job['f']};second={job['g']};", f"polresultant(first,second,{job['elim']})"
        value = "answer"
    elif kind in ("mul", "gcd"):
        run = {"mul": "first*second", "gcd": "gcd(first,second)"}[kind]
        given, value = f"first={job['f']};second={job['g']};", "answer"
    else:
        given, run = f"divisor={job.get('div') or 1};", f"product={job['expr']};for(i=1,{job.get('times', 0)},product=product\\divisor);product"
        value = "answer"
    after = "" if kind in ("polydet", "roots") else at
    script = f"""default(parisizemax,"8G");
{';'.join(names)};
{given}
run()={{{run}}};
start=getabstime();answer=run();once=getabstime()-start;times=max(1,min(2000,600\\max(once,1)));
start=getabstime();for(i=1,times,answer=run());spent=getabstime()-start;
printf("T %.9f\\n",spent/times/1000.);
{after}
print("VAL ",{value});
quit
"""
    print(subprocess.run(["gp", "-q", "-f"], input=script, capture_output=True, text=True).stdout)


# ----------------------------------------------------------------------------------------------------- comparison

def run_peer(peer, job, limit=60):
    """Seconds, peak memory in MB and the value modulo the prime; or why there is none."""
    command = {
        "looproot": [PROGRAM, "poly", "job", str(HERE / "jobs" / f"{job}.json")],
    }.get(peer, [sys.executable, __file__, "--peer", peer, job])
    environment = dict(os.environ, SYMBOLICA_HIDE_BANNER="1")
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment,
                               start_new_session=True)
    timer = time.time()
    try:
        text, _ = process.communicate(timeout=limit)
    except subprocess.TimeoutExpired:
        # PARI is a process of the process.
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return {"failure": f"> {time.time() - timer:.0f} s"}
    found = re.search(r"^T\s+(\S+)", text, re.M)
    if not found:
        return {"failure": text.strip()[-80:] or "no answer"}
    memory = re.search(r"^RSS\s+(\d+)", text, re.M)
    value = re.search(r"^VAL\s+(-?\d+)(?:/(\d+))?\s*$", text, re.M)
    residue = None
    if value:
        residue = int(value[1]) * pow(int(value[2] or 1), -1, PRIME) % PRIME
        residue = min(residue, PRIME - residue)
    return {"seconds": float(found[1]), "memory": int(memory[1]) // 1024 if memory else None, "value": residue}


def versions():
    lines = [subprocess.run([PROGRAM, "--version"], capture_output=True, text=True).stdout.strip()]
    try:
        import flint
        lines.append(f"FLINT {flint.__FLINT_VERSION__} in python-flint {flint.__version__}")
    except ImportError:
        pass
    try:
        from importlib.metadata import version
        lines.append(f"Symbolica {version('symbolica')}, one core")
    except ImportError:
        pass
    if shutil.which("gp"):
        lines.append("PARI " + subprocess.run(["gp", "--version-short"], capture_output=True, text=True).stdout.strip())
    return lines


def milliseconds(seconds):
    return f"{seconds * 1e3:.3g}"


def main():
    sys.set_int_max_str_digits(0)
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("jobs", nargs="*")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--only", default=",".join(PEERS))
    parser.add_argument("--peer", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.peer:
        {"flint": flint_job, "symbolica": symbolica_job, "pari": pari_job}[options.peer](load(options.jobs[0]))
        usage = re.search(r"VmHWM:\s+(\d+)", Path("/proc/self/status").read_text())
        if usage and options.peer != "pari":
            print("RSS", usage[1])
        return
    peers = options.only.split(",")
    jobs = options.jobs or sorted(p.stem for p in (HERE / "jobs").glob("*.json"))
    print("; ".join(versions()), end="\n\n")
    print("| job | " + " | ".join(f"{peer} [ms]" for peer in peers) + " | " + " | ".join(f"{p} / looproot" for p in peers[1:])
          + " | MB " + " / ".join(peers) + " |")
    print("|---" * (2 * len(peers) + 1) + "|")
    for job in jobs:
        best = {}
        for _ in range(options.rounds):
            for peer in peers:
                if "failure" in best.get(peer, {}):
                    continue
                result = run_peer(peer, job)
                if peer not in best or "failure" in result or result["seconds"] < best[peer]["seconds"]:
                    best[peer] = result
        values = {r["value"] for r in best.values() if r.get("value") is not None}
        if len(values) > 1:
            sys.exit(f"{job}: the systems disagree: {[(p, r.get('value')) for p, r in best.items()]}")
        cells = [milliseconds(best[p]["seconds"]) if "seconds" in best[p] else best[p]["failure"] for p in peers]
        own = best[peers[0]].get("seconds")
        ratios = [f"{best[p]['seconds'] / own:.2f}" if own and "seconds" in best[p] else "" for p in peers[1:]]
        memory = " / ".join(str(best[p].get("memory") or "–") for p in peers)
        print(f"| {job} | " + " | ".join(cells + ratios) + f" | {memory} |", flush=True)


if __name__ == "__main__":
    main()
