//! What the manifest says about an instance, as a constant.

use std::time::Duration;

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::layout::doc;
use super::nodes::quote_on_failure;
use super::spelling::ident;
use crate::model::recording::RecordModel;
use crate::model::runtime::InstanceModel;
use crate::model::{CyclerKind, Scheduling};

/// `pub const VISION_TOP: InstanceDescription = …;`
pub(super) fn quote_description(instance: &InstanceModel) -> TokenStream {
    let description = &instance.description;
    let constant = ident(&instance.constant);
    let (name, cycler) = (&instance.name, &description.cycler);
    let kind = match description.kind {
        CyclerKind::Perception => quote!(::framework::Kind::Perception),
        CyclerKind::RealTime => quote!(::framework::Kind::RealTime),
    };
    let on_failure = quote_on_failure(description.on_failure);
    let deadline = quote_option(description.deadline.map(quote_duration));
    let pending_timeout = quote_duration(description.pending_timeout);
    let watchdog = quote_duration(description.watchdog);
    let history = quote_duration(description.history);
    let lockstep_duration = quote_option(description.lockstep_duration.map(quote_duration));
    let scheduling = quote_scheduling(&description.scheduling);
    let record = quote_record(&description.record);
    let about = doc(&format!("What the manifest says about `{name}`."));
    quote! {
        #about
        pub const #constant: ::framework::InstanceDescription = ::framework::InstanceDescription {
            name: #name,
            cycler: #cycler,
            kind: #kind,
            on_failure: #on_failure,
            deadline: #deadline,
            pending_timeout: #pending_timeout,
            watchdog: #watchdog,
            history: #history,
            lockstep_duration: #lockstep_duration,
            scheduling: #scheduling,
            record: #record,
        };
    }
}

fn quote_record(record: &RecordModel) -> TokenStream {
    match record {
        RecordModel::On => quote!(::framework::Record::On),
        RecordModel::Off => quote!(::framework::Record::Off),
        RecordModel::Every(cycles) => {
            let cycles = Literal::u32_unsuffixed(*cycles);
            quote!(::framework::Record::Every(#cycles))
        }
        RecordModel::While { instance, path } => {
            quote!(::framework::Record::While { instance: #instance, path: #path })
        }
    }
}

/// A duration in the largest unit that says it in whole numbers.
pub(super) fn quote_duration(duration: Duration) -> TokenStream {
    let nanoseconds = duration.as_nanos();
    let units = [
        ("from_secs", 1_000_000_000),
        ("from_millis", 1_000_000),
        ("from_micros", 1_000),
        ("from_nanos", 1),
    ];
    let (unit, length) = units
        .into_iter()
        .find(|(_, length)| nanoseconds.is_multiple_of(*length))
        .expect("every duration is a whole number of nanoseconds");
    let (unit, count) = (ident(unit), Literal::u128_unsuffixed(nanoseconds / length));
    quote!(::std::time::Duration::#unit(#count))
}

fn quote_scheduling(scheduling: &Scheduling) -> TokenStream {
    if *scheduling == Scheduling::default() {
        return quote!(::framework::Scheduling::BY_THE_SYSTEM);
    }
    let policy = quote_option(scheduling.policy.as_deref().map(|policy| match policy {
        "fifo" => quote!(::framework::Policy::Fifo),
        "round-robin" => quote!(::framework::Policy::RoundRobin),
        _ => quote!(::framework::Policy::Other),
    }));
    let priority = quote_option(scheduling.priority.map(|priority| {
        let priority = Literal::u8_unsuffixed(priority);
        quote!(#priority)
    }));
    let cores = scheduling
        .cores
        .iter()
        .map(|core| Literal::usize_unsuffixed(*core));
    quote! {
        ::framework::Scheduling {
            policy: #policy,
            priority: #priority,
            cores: &[#(#cores),*],
        }
    }
}

fn quote_option(value: Option<TokenStream>) -> TokenStream {
    value.map_or_else(|| quote!(None), |value| quote!(Some(#value)))
}
