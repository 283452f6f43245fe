//! The manifest as text and JSON: what it says, defaults left out.

use serde_json::{Value, json};

use crate::manifest::{Cycler, Manifest, Target};

/// As the schema names it; nodes and instances under the names that they have in the robot.
pub fn to_json(manifest: &Manifest) -> Value {
    let cyclers = manifest.cyclers.iter().map(|cycler| {
        let instances = cycler.instances.iter();
        let instances: Vec<&str> = instances.map(|instance| instance.name.as_str()).collect();
        json!({ "declared": cycler.declared, "instances": instances })
    });
    let targets = manifest.targets.iter().map(|target| &target.declared);
    json!({
        "robot": manifest.robot,
        "cyclers": cyclers.collect::<Vec<_>>(),
        "targets": targets.collect::<Vec<_>>(),
    })
}

/// Robot, cyclers with their nodes, targets, in manifest order.
pub fn text(manifest: &Manifest) -> String {
    let robot = &manifest.robot;
    let mut text = format!(
        "robot {}\n  generated in {}, parameters in {}\n",
        robot.name, robot.generated, robot.parameters
    );
    if !robot.identities.is_empty() {
        let identities: Vec<String> = robot.identities.iter().map(ToString::to_string).collect();
        text.push_str(&format!("  identities {}\n", identities.join(", ")));
    }
    for cycler in &manifest.cyclers {
        write_cycler(&mut text, cycler);
    }
    for target in &manifest.targets {
        write_target(&mut text, target);
    }
    text
}

fn write_cycler(text: &mut String, cycler: &Cycler) {
    let declared = &cycler.declared;
    let kind = match declared.kind {
        schema::CyclerKind::Perception => "perception",
        schema::CyclerKind::RealTime => "real-time",
    };
    let instances: Vec<String> = cycler
        .instances
        .iter()
        .map(|instance| instance.name.to_string())
        .collect();
    text.push_str(&format!(
        "\ncycler {} ({kind}): {}\n",
        declared.name,
        instances.join(", ")
    ));
    let durations = [
        ("deadline", declared.deadline),
        ("pending timeout", declared.pending_timeout),
        ("watchdog", declared.watchdog),
        ("history", declared.history),
        ("lockstep duration", declared.lockstep_duration),
    ];
    let mut settings: Vec<String> = durations
        .into_iter()
        .filter_map(|(name, duration)| Some(format!("{name} {}", duration?)))
        .collect();
    settings.extend(declared.queue.map(|queue| format!("queue {queue}")));
    settings.extend(declared.remote.then(|| "run by another machine".to_owned()));
    if declared.on_failure != schema::OnFailure::default() {
        settings.push(format!("on failure {}", on_failure(declared.on_failure)));
    }
    if !settings.is_empty() {
        text.push_str(&format!("  {}\n", settings.join(", ")));
    }
    for node in &cycler.nodes {
        let kind = if node.setup { "setup node" } else { "node" };
        let own = node
            .on_failure
            .map(|own| format!(" (on failure {})", on_failure(own)));
        text.push_str(&format!(
            "  {kind} {}{}\n",
            node.path,
            own.unwrap_or_default()
        ));
    }
}

fn write_target(text: &mut String, target: &Target) {
    let declared = &target.declared;
    text.push_str(&format!(
        "\ntarget {}: {}\n",
        declared.name, declared.hardware
    ));
    let settings: Vec<String> = [
        ("triple", &declared.triple),
        ("cpu", &declared.cpu),
        ("profile", &declared.profile),
        ("location", &declared.location),
    ]
    .into_iter()
    .filter_map(|(name, value)| Some(format!("{name} {}", value.as_deref()?)))
    .collect();
    if !settings.is_empty() {
        text.push_str(&format!("  {}\n", settings.join(", ")));
    }
}

fn on_failure(on_failure: schema::OnFailure) -> &'static str {
    match on_failure {
        schema::OnFailure::Stop => "stop",
        schema::OnFailure::Restart => "restart",
        schema::OnFailure::Skip => "skip",
        schema::OnFailure::Hold => "hold",
    }
}
