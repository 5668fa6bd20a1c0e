// SPDX-License-Identifier: MIT

/** A failure that rhw tells of, in one line. */
export class RhwError extends Error {
    constructor(message) {
        super(message);
        this.name = 'RhwError';
    }
}
