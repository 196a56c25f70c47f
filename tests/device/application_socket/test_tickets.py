"""Tickets: each goes out once and comes back once, whatever the order."""

from hypothesis import strategies as st
from hypothesis.stateful import Bundle, RuleBasedStateMachine, consumes, invariant, rule

from controller.device.application_socket.requests.tickets import FULL, Tickets, Waiting

CAPACITY = 5


class TicketsAgainstADictionary(RuleBasedStateMachine):
    out = Bundle("out")
    old = Bundle("old")

    def __init__(self):
        super().__init__()
        self.tickets = Tickets(CAPACITY)
        self.model = {}
        self.number = 0

    @rule(target=out)
    def take(self):
        self.number += 1
        holder = Waiting(self.number, f"id {self.number}")
        ticket = self.tickets.take(holder)
        assert (ticket == FULL) == (len(self.model) == CAPACITY)
        if ticket != FULL:
            assert ticket not in self.model
            self.model[ticket] = holder
        return ticket

    @rule(target=old, ticket=consumes(out))
    def give_back(self, ticket):
        if ticket != FULL:
            assert self.tickets.give_back(ticket) == self.model.pop(ticket)
        return ticket

    @rule(ticket=old)
    def a_second_time_finds_nobody(self, ticket):
        if ticket != FULL:
            assert self.tickets.give_back(ticket) is None

    @rule(ticket=st.integers(0, 50))
    def one_that_was_never_out_finds_nobody(self, ticket):
        if ticket not in self.model:
            assert self.tickets.give_back(ticket) is None

    @invariant()
    def count_is_right(self):
        assert self.tickets.waiting == len(self.model)


TestTickets = TicketsAgainstADictionary.TestCase
