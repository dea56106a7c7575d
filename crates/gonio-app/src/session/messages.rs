//! Messages, which stay until they are dismissed.

/// Severity of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum MessageSeverity {
    /// Worth knowing.
    Note,
    /// The result is not as expected.
    Warning,
    /// The operation failed.
    Error,
}

/// A message of one sentence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UserMessage {
    /// Identifies the message.
    pub id: u64,
    /// Severity of a message.
    pub severity: MessageSeverity,
    /// The sentence.
    pub text: String,
    /// Number of times that it was reported.
    pub times: u32,
}

/// Messages that have not been dismissed.
#[derive(Clone, Debug, Default)]
pub struct Messages {
    list: Vec<UserMessage>,
    next: u64,
}

impl Messages {
    /// Adds a message. A repeated one is counted.
    pub fn report(&mut self, severity: MessageSeverity, text: impl Into<String>) {
        let text = text.into();
        if let Some(known) = self.list.iter_mut().find(|m| m.severity == severity && m.text == text) {
            known.times += 1;
            return;
        }
        self.list.push(UserMessage { id: self.next, severity, text, times: 1 });
        self.next += 1;
    }

    /// Removes a message.
    pub fn dismiss(&mut self, id: u64) {
        self.list.retain(|message| message.id != id);
    }

    /// Removes the messages with this text, which no longer hold.
    pub fn withdraw(&mut self, text: &str) {
        self.list.retain(|message| message.text != text);
    }

    /// Removes all messages except errors.
    pub fn forget_remarks(&mut self) {
        self.list.retain(|message| message.severity == MessageSeverity::Error);
    }

    /// The messages in order.
    pub fn list(&self) -> &[UserMessage] {
        &self.list
    }

    /// The last error that has not been dismissed.
    pub fn last_error(&self) -> Option<&str> {
        self.list.iter().rev().find(|m| m.severity == MessageSeverity::Error).map(|m| m.text.as_str())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_stay_until_dismissed_and_repeats_are_counted() {
        let mut messages = Messages::default();
        messages.report(MessageSeverity::Error, "no such file");
        messages.report(MessageSeverity::Error, "no such file");
        messages.report(MessageSeverity::Note, "lit by its own light");
        assert_eq!(messages.list().len(), 2);
        assert_eq!(messages.list()[0].times, 2);
        messages.forget_remarks();
        assert_eq!(messages.last_error(), Some("no such file"));
        assert_eq!(messages.list().len(), 1);
        messages.dismiss(messages.list()[0].id);
        assert_eq!(messages.last_error(), None);
    }
}
