"""Many length vectors from a file: solved by many processes, written row by row, and taken up again when interrupted.

``lengths`` reads the rows, ``job`` answers one of them as a ``record``, ``local`` and ``cluster`` have processes that
do so, ``journal`` keeps what is finished, and ``run`` joins them. The output depends on the input alone: not on the
number of processes, where they run, in which order they finish, or how often the run was interrupted.
"""
