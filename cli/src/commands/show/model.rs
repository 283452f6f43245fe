//! The model of the generated crate as text: what each file will hold, in short.

use crate::model::cycler::{Calls, CyclerModel, Source};
use crate::model::frame::{FrameField, Hardware};
use crate::model::structs::{FieldType, Struct};
use crate::model::{RuntimeModel, package};

/// File by file.
pub fn text(model: &RuntimeModel) -> String {
    let mut text = format!("package {} in {}\n", model.package.name, model.folder);
    write_package(&mut text, &model.package);
    text.push_str("\nparameters\n");
    write_structs(&mut text, &model.parameters.structs);
    for cycler in &model.cyclers {
        write_cycler(&mut text, cycler);
    }
    text.push_str("\nruntime\n");
    for instance in &model.runtime.instances {
        text.push_str(&format!("  instance {}\n", instance.name));
        let buffer = model.runtime.buffer(instance.id);
        write_list(&mut text, "    read by", &buffer.readers);
        write_list(&mut text, "    consumed by", &buffer.consumers);
    }
    write_list(&mut text, "  hardware", &model.runtime.hardware);
    for binary in &model.binaries {
        text.push_str(&format!("\nbinary {}: {}\n", binary.name, binary.hardware));
    }
    text
}

fn write_package(text: &mut String, package: &package::Package) {
    for dependency in &package.dependencies {
        text.push_str(&format!("  {dependency}\n"));
    }
    for target in &package.targets {
        let needs = match target.dependencies.as_slice() {
            [] => String::new(),
            needs => format!(": {}", needs.join(", ")),
        };
        text.push_str(&format!("  feature {}{needs}\n", target.feature));
    }
}

fn write_cycler(text: &mut String, cycler: &CyclerModel) {
    text.push_str(&format!(
        "\ncycler {} in module {}\n",
        cycler.name, cycler.module
    ));
    for (title, shared) in [("own outputs", false), ("shared outputs", true)] {
        let outputs = cycler
            .outputs
            .iter()
            .filter(|output| output.shared == shared);
        let outputs = outputs.map(|output| {
            let mark = if output.historic { " (historic)" } else { "" };
            format!("{}: {}{mark}", output.name, output.data)
        });
        write_list(text, &format!("  {title}"), &outputs.collect::<Vec<_>>());
    }
    write_structs(text, &cycler.additional_structs);
    write_structs(text, &cycler.state_structs);
    let procedures = cycler.procedures.iter();
    let procedures =
        procedures.map(|one| format!("{}({}) -> {}", one.name, one.request, one.response));
    write_list(text, "  procedures", &procedures.collect::<Vec<_>>());
    write_list(text, "  latest", &fields(&cycler.latest));
    if let Some(perception) = &cycler.perception {
        write_list(text, "  perception", &fields(&perception.lanes));
        for order in &perception.interleavings {
            write_list(
                text,
                &format!("  interleaved as {}", order.field),
                &order.lanes,
            );
        }
    }
    write_list(text, "  creation", &names(&cycler.creation));
    write_list(text, "  frame", &names(&cycler.frame));
    write_calls(text, "setup", &cycler.setup);
    write_calls(text, "cycle", &cycler.cycle);
    for node in &cycler.nodes {
        text.push_str(&format!("  step {}: {}\n", node.name, node.step.flow));
    }
}

fn write_calls(text: &mut String, title: &str, calls: &Calls) {
    let hardware = match &calls.hardware {
        Hardware::Asked(traits) if !traits.is_empty() => format!(" asks {}", traits.join(" + ")),
        Hardware::Asked(_) | Hardware::Absent => String::new(),
    };
    write_list(text, &format!("  {title}{hardware}"), &calls.nodes);
}

fn write_structs(text: &mut String, structs: &[Struct]) {
    for one in structs {
        text.push_str(&format!("  struct {}\n", one.name));
        for field in &one.fields {
            let (FieldType::Data(content) | FieldType::Struct(content)) = &field.content;
            text.push_str(&format!("    {}: {content}\n", field.name));
        }
    }
}

fn write_list(text: &mut String, title: &str, entries: &[String]) {
    if !entries.is_empty() {
        text.push_str(&format!("{title}: {}\n", entries.join(", ")));
    }
}

fn fields(sources: &[Source]) -> Vec<String> {
    sources.iter().map(|source| source.field.clone()).collect()
}

fn names(fields: &[FrameField]) -> Vec<String> {
    fields.iter().map(|field| field.name().to_owned()).collect()
}
