//! Who reads an output, as far as that decides where it is kept.

use super::robot::{CycleBinding, Cycler};

/// Marks every output by who reads it.
pub(super) fn mark_readers(cyclers: &mut [Cycler]) {
    for reader in 0..cyclers.len() {
        let bindings: Vec<CycleBinding> = cyclers[reader]
            .nodes
            .iter()
            .flat_map(|node| node.cycle.iter().map(|field| field.binding.clone()))
            .collect();
        for binding in bindings {
            let Some(read) = binding.read() else {
                continue;
            };
            let cycler = read
                .instances
                .first()
                .map_or(reader, |instance| instance.cycler);
            let name = &read.access.segments[0].name;
            let output = cyclers[cycler]
                .outputs
                .iter_mut()
                .find(|output| output.name == *name);
            if let Some(output) = output {
                output.shared |= !read.instances.is_empty();
                output.historic |= matches!(binding, CycleBinding::Historic { .. });
                output.previous |= matches!(binding, CycleBinding::Previous { .. });
            }
        }
    }
}
