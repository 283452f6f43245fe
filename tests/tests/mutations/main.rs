//! Mutations of the NAO: whatever breaks a rule of the contract is reported where it was broken, and nothing else is.
//!
//! Every mutation of twelve kinds is made at every place, one at a time. An oracle of the test's own, which shares no code
//! with hulkgen, says which of them break a rule.

mod compiled;
mod mutants;
mod oracle;
mod parameters;
mod reading;
mod robot;

use std::collections::BTreeMap;
use std::fs;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use hulkgen::diagnostics::{Diagnostics, Severity};
use hulkgen::pipeline;
use hulkgen::workspace::{Changes, Workspace};
use support::{root, sources};

use mutants::{KINDS, Mutant};
use oracle::Breach;
use robot::Robot;

/// `understand` is single-threaded; mutants are shared among so many threads.
const THREADS: usize = 2;

/// How hulkgen took a mutant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Verdict {
    Accepted,
    /// No rule is broken, an error is given.
    FalseAlarm,
    /// A rule is broken, no error is given.
    Missed,
    /// Errors, but none at the mutation or at what it disagrees with.
    Elsewhere,
    AtPlace,
}

/// Path and text of every file of the repository that hulkgen reads.
fn texts() -> BTreeMap<String, String> {
    let folders = [
        "cli",
        "docs/examples",
        "framework",
        "generated",
        "robotics",
        "schema",
        "templates",
        "tests",
        "web",
    ];
    let mut texts: BTreeMap<String, String> = sources(&["framework", "robotics"], ".rs")
        .into_iter()
        .chain(sources(&folders, ".toml"))
        .map(|source| (source.path, source.text))
        .collect();
    for file in ["Cargo.toml", "hulk.toml", "robotics/nao/robot.service"] {
        let text = fs::read_to_string(root().join(file));
        texts.insert(file.to_owned(), text.expect("the root has it"));
    }
    texts
}

fn without_bodies(mut texts: BTreeMap<String, String>) -> BTreeMap<String, String> {
    for (_, text) in texts.iter_mut().filter(|(path, _)| path.ends_with(".rs")) {
        *text = reading::without_bodies(text);
    }
    texts
}

/// `HULKGEN_MUTATIONS=10` is every tenth mutant, `1` all of them; else one at every eleventh place.
fn chosen(mutants: Vec<Mutant>) -> Vec<Mutant> {
    let step = std::env::var("HULKGEN_MUTATIONS").ok();
    match step.map(|step| step.parse().expect("it is a number")) {
        Some(step) => mutants.into_iter().step_by(step).collect(),
        None => one_at_each_place(mutants).into_iter().step_by(11).collect(),
    }
}

/// Of the variations of a kind at one place one, another at the next place.
fn one_at_each_place(mutants: Vec<Mutant>) -> Vec<Mutant> {
    let mut places: BTreeMap<_, Vec<Mutant>> = BTreeMap::new();
    for mutant in mutants {
        let place = (mutant.kind, mutant.file.clone(), mutant.bytes.start);
        places.entry(place).or_default().push(mutant);
    }
    let one = |(turn, mut variations): (usize, Vec<Mutant>)| {
        let index = turn % variations.len();
        variations.swap_remove(index)
    };
    places.into_values().enumerate().map(one).collect()
}

/// Lines of these bytes, counted from 0.
fn lines(text: &str, bytes: &Range<usize>) -> Range<usize> {
    let line = |at: usize| text[..at.min(text.len())].matches('\n').count();
    line(bytes.start)..line(bytes.end) + 1
}

/// What hulkgen says of a mutant, compared with the oracle's breaches; and what it said.
fn judge(
    workspace: &Workspace,
    texts: &BTreeMap<String, String>,
    mutant: &Mutant,
    breaches: &[Breach],
) -> (Verdict, String) {
    let mutated = mutant.apply(&texts[&mutant.file]);
    let text_of = |file: &str| {
        if file == mutant.file {
            &mutated
        } else {
            &texts[file]
        }
    };
    let changes = Changes::from([(mutant.file.clone().into(), Some(mutated.clone()))]);
    let mut diagnostics = Diagnostics::new();
    let understood = pipeline::understand(&workspace.after(&changes), &mut diagnostics);
    let sorted = diagnostics.sorted();
    let errors: Vec<_> = sorted
        .iter()
        .filter(|one| one.severity() == Severity::Error)
        .collect();
    assert!(
        understood.is_ok() || !errors.is_empty(),
        "a stage failed silently"
    );
    let said = errors
        .iter()
        .map(|error| format!("{}: {} {:?}", error.code.name(), error.message, error.spans));
    let said = said.collect::<Vec<_>>().join("\n    ");
    let end = mutant.bytes.start + mutant.text.len();
    let own = (mutant.file.clone(), Some(mutant.bytes.start..end));
    let right: Vec<(&str, Option<Range<usize>>)> = breaches
        .iter()
        .flat_map(|breach| &breach.places)
        .chain([&own])
        .map(|(file, bytes)| {
            (
                file.as_str(),
                bytes.as_ref().map(|bytes| lines(text_of(file), bytes)),
            )
        })
        .collect();
    let is_right = |file: &str, bytes: &Range<usize>| {
        right.iter().any(|(right, wanted)| {
            let found = || lines(text_of(file), bytes);
            *right == file
                && wanted
                    .as_ref()
                    .is_none_or(|wanted| found().start < wanted.end && wanted.start < found().end)
        })
    };
    let mut spans = errors.iter().flat_map(|error| &error.spans);
    let verdict = match (breaches.is_empty(), errors.is_empty()) {
        (true, true) => Verdict::Accepted,
        (true, false) => Verdict::FalseAlarm,
        (false, true) => Verdict::Missed,
        (false, false) if spans.any(|span| is_right(span.file.as_str(), &span.range)) => {
            Verdict::AtPlace
        }
        (false, false) => Verdict::Elsewhere,
    };
    (verdict, said)
}

/// The robot with every file parsed: what a mutation does not touch is not parsed again.
fn parsed(texts: &BTreeMap<String, String>) -> Workspace {
    let workspace = Workspace::in_memory(texts.clone());
    let understood = pipeline::understand(&workspace, &mut Diagnostics::new());
    assert!(understood.is_ok(), "the robot itself is right");
    workspace
}

/// Every mutant with its verdict; those that are wrong with what was said.
fn judge_all(
    texts: &BTreeMap<String, String>,
    robot: &Robot,
    mutants: &[Mutant],
) -> Vec<(usize, Verdict, String)> {
    let next = AtomicUsize::new(0);
    let work = || {
        let mut judged = Vec::new();
        let mut workspace = parsed(texts);
        loop {
            // Only the count is shared; each thread keeps its own results.
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(mutant) = mutants.get(index) else {
                return judged;
            };
            // What was parsed stays in memory until all of it is parsed anew.
            if judged.len() % 500 == 499 {
                workspace = parsed(texts);
            }
            let mutated = robot.with(&mutant.file, &mutant.apply(&texts[&mutant.file]));
            let breaches = oracle::breaches(&mutated);
            let (verdict, said) = judge(&workspace, texts, mutant, &breaches);
            let rules: Vec<_> = breaches.iter().map(|breach| breach.rule).collect();
            judged.push((index, verdict, format!("{rules:?}\n    {said}")));
        }
    };
    let mut judged: Vec<_> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..THREADS).map(|_| scope.spawn(work)).collect();
        threads
            .into_iter()
            .flat_map(|thread| thread.join().expect("a mutant panics nobody"))
            .collect()
    });
    judged.sort_by_key(|(index, ..)| *index);
    judged
}

#[test]
fn every_mutation_that_breaks_a_rule_is_reported_where_it_was_made() {
    let texts = without_bodies(texts());
    let robot = Robot::new(&texts);
    let breaches = oracle::breaches(&robot);
    assert!(
        breaches.is_empty(),
        "the oracle accepts the robot: {breaches:#?}"
    );
    let mutants = chosen(mutants::mutants(&robot, &texts));
    let started = Instant::now();
    let judged = judge_all(&texts, &robot, &mutants);
    println!("{} mutants in {:.1?}", mutants.len(), started.elapsed());
    println!("| kind | mutants | breaking | reported | at the place | false alarms |");
    for kind in KINDS {
        let of_kind = judged
            .iter()
            .filter(|(index, ..)| mutants[*index].kind == kind);
        let count = |verdicts: &[Verdict]| {
            of_kind
                .clone()
                .filter(|(_, one, _)| verdicts.contains(one))
                .count()
        };
        use Verdict::{Accepted, AtPlace, Elsewhere, FalseAlarm, Missed};
        let all = count(&[Accepted, AtPlace, Elsewhere, FalseAlarm, Missed]);
        let breaking = count(&[AtPlace, Elsewhere, Missed]);
        let reported = count(&[AtPlace, Elsewhere]);
        println!(
            "| {kind} | {all} | {breaking} | {reported} | {} | {} |",
            count(&[AtPlace]),
            count(&[FalseAlarm])
        );
        assert!(breaking > 0, "no mutant breaks a rule: {kind}");
    }
    let wrong: Vec<_> = judged
        .iter()
        .filter(|(_, verdict, _)| !matches!(verdict, Verdict::Accepted | Verdict::AtPlace))
        .collect();
    for (index, verdict, said) in &wrong {
        let Mutant {
            kind,
            file,
            bytes,
            text,
        } = &mutants[*index];
        let old = &texts[file][bytes.clone()];
        println!(
            "{verdict:?} {kind}: {file}:{} `{old}` -> `{text}`\n    {said}",
            lines(&texts[file], bytes).start + 1
        );
    }
    assert!(
        wrong.is_empty(),
        "{} mutants are taken wrongly",
        wrong.len()
    );
}
